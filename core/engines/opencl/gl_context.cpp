#include "core/engines/opencl/opencl_devices.h"

#include <mutex>
#include <vector>

namespace tyglab {
namespace {

std::mutex mutex;
std::vector<GlContext> all_in_use;

}  // namespace

GlContextInUse::GlContextInUse(GlContext context) {
  static std::uint64_t numbers = 0;
  const std::lock_guard lock(mutex);
  context.number = number_ = ++numbers;
  if (context.context != nullptr) all_in_use.push_back(context);
}

GlContextInUse::~GlContextInUse() {
  const std::lock_guard lock(mutex);
  std::erase_if(all_in_use, [this](const GlContext& context) { return context.number == number_; });
}

GlContext gl_context_in_use() {
  const std::lock_guard lock(mutex);
  return all_in_use.empty() ? GlContext{} : all_in_use.back();
}

}  // namespace tyglab
