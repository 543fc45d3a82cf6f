#include "tests/support/devices.h"

#include "core/engines/opencl/opencl_devices.h"
#include "tests/support/skip.h"

namespace tyglab::test {
namespace {

const OpenClInventory& inventory() {
  static const OpenClInventory found = opencl_devices();
  return found;
}

}  // namespace

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
