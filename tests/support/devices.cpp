#include "tests/support/devices.h"

#include <cstdio>

#include "core/engines/opencl/opencl_devices.h"

namespace tyglab::test {

bool device_there() {
  static const bool there = [] {
    const OpenClInventory inventory = opencl_devices();
    if (inventory.devices.empty())
      std::printf("NOT TESTED: there is no OpenCL device here%s; apt-get install pocl-opencl-icd makes one.\n",
                  inventory.problem.empty() ? "" : (" (" + inventory.problem + ")").c_str());
    return !inventory.devices.empty();
  }();
  return there;
}

}  // namespace tyglab::test
