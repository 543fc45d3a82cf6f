#include <dlfcn.h>

#include <cstdlib>

#include "tests/support/failing_driver.h"

namespace tyglab::test {
namespace {

/// A function of the layer; null where the loader has none.
template <class Function>
Function of_layer(const char* name) {
  const char* path = std::getenv("OPENCL_LAYERS");
  void* const layer = path == nullptr ? nullptr : ::dlopen(path, RTLD_NOW);
  return layer == nullptr ? nullptr : reinterpret_cast<Function>(::dlsym(layer, name));
}

}  // namespace

bool driver_layer_loaded() {
  return of_layer<decltype(&tyglab_driver_calls)>("tyglab_driver_calls") != nullptr;
}

void fail_driver_from(std::int64_t n) {
  static const auto fail = of_layer<decltype(&tyglab_fail_driver_from)>("tyglab_fail_driver_from");
  if (fail != nullptr) fail(n);
}

std::int64_t driver_calls() {
  static const auto calls = of_layer<decltype(&tyglab_driver_calls)>("tyglab_driver_calls");
  return calls == nullptr ? 0 : calls();
}

}  // namespace tyglab::test
