#include "app/process/child.h"
#include "app/process/driver_probe.h"
#include "core/engines/opencl/opencl_devices.h"

namespace tyglab {

void probe_drivers_in_child() {
  set_driver_probe([](const std::function<void()>& ask) {
    constexpr double most_seconds = 30;  // a driver that hangs is as bad
    try {
      const auto work = [&]() noexcept { return ask(), std::string(); };  // what is thrown is a crash too
      const ChildExit exit = run_in_child(work, {.most_seconds = most_seconds, .silent = true});
      return exit.signal == 0 && exit.code == 0;  // some end the process instead
    } catch (const ChildError&) {
      return true;  // nothing is known against them
    }
  });
}

}  // namespace tyglab
