#include <dlfcn.h>

#include <chrono>
#include <filesystem>
#include <system_error>

#include "app/base/files.h"
#include "app/python/bindings.h"
#include "tyglab_version.h"

namespace tyglab::python {
namespace {

/// Of this very code: the module's, not the interpreter's.
std::filesystem::path own_file() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<void*>(&own_file), &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  return std::filesystem::canonical(info.dli_fname, ignored);
}

}  // namespace

Stop Interrupt::stop() {
  using Clock = std::chrono::steady_clock;
  static constexpr auto between = std::chrono::milliseconds(50);
  return [this, next = Clock::now() + between]() mutable {
    if (raised_ || Clock::now() < next) return raised_;
    const py::gil_scoped_acquire lock;
    raised_ = PyErr_CheckSignals() != 0;
    next = Clock::now() + between;
    return raised_;
  };
}

void Interrupt::raise() const {
  if (raised_) throw py::error_already_set();
}

}  // namespace tyglab::python

PYBIND11_MODULE(tyglab, module) {
  using namespace tyglab::python;
  // In the build tree the module stands in build/release/python, installed among Python's packages.
  const std::filesystem::path built = own_file().parent_path().parent_path() / "share" / "tyglab";
  std::error_code ignored;
  tyglab::set_data_folder(std::filesystem::exists(built, ignored) ? built
                                                                  : std::filesystem::path(TYGLAB_INSTALLED_DATA));

  module.doc() =
      "Cloth simulation and its numerical methods: presets, simulations, studies. All numbers are in SI units; "
      "particle (i, j) stands in row i, 0 at the top, and column j, 0 at the left.";
  module.attr("__version__") = TYGLAB_VERSION;
  add_errors(module);
  add_preset(module);
  add_simulation(module);
  add_studies(module);
}
