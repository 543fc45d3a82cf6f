#include "tests/support/devices.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/engines/opencl/opencl_devices.h"
#include "tests/support/skip.h"

namespace tyglab::test {
namespace {

const OpenClInventory& inventory() {
  static const OpenClInventory found = opencl_devices();
  return found;
}

}  // namespace

void probe_drivers_in_child() {
  set_driver_probe([](const std::function<void()>& ask) {
    const pid_t child = fork();
    if (child == 0) {
      constexpr int most_seconds = 60;  // another thread may hold a lock of the sanitizers that this one waits for
      alarm(most_seconds);
      dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
      ask();
      _exit(0);
    }
    int status = 0;
    return child < 0 || (waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0);
  });
}

bool device_there() {
  return !inventory().devices.empty();
}

bool skipped_without_device() {
  if (device_there()) return false;
  const std::string& problem = inventory().problem;
  skip("there is no OpenCL device here" + (problem.empty() ? "" : " (" + problem + ")") +
       "; apt-get install pocl-opencl-icd makes one");
  return true;
}

}  // namespace tyglab::test
