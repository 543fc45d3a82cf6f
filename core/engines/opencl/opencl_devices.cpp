// What can be said of devices and methods without asking any device.
#include "core/engines/opencl/opencl_devices.h"

#include <algorithm>

#include "core/integrators/scheme.h"

namespace tyglab {

int preferred_device(const std::vector<OpenClDevice>& devices) {
  const auto card =
      std::find_if(devices.begin(), devices.end(), [](const OpenClDevice& device) { return device.card; });
  return card == devices.end() ? 0 : int(card - devices.begin());
}

bool runs_on_opencl(const Scheme& method) {
  return !projects(method) && !chooses_steps(method);
}

}  // namespace tyglab
