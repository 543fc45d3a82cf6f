#include "app/process/driver_probe.h"

#include "app/process/child.h"
#include "core/engines/opencl/opencl_devices.h"

namespace tyglab {

void probe_drivers_in_child() {
  set_driver_probe([](const std::function<void()>& ask) {
    constexpr double most_seconds = 30;  // a driver that hangs is as bad
    try {
      const auto work = [&]() noexcept { return ask(), std::string(); };  // what is thrown is a crash too
      return run_in_child(work, {.most_seconds = most_seconds, .silent = true}).signal == 0;
    } catch (const ChildError&) {
      return true;  // nothing is known against them
    }
  });
}

}  // namespace tyglab
