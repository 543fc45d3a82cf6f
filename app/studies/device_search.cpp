#include "app/studies/device_search.h"

#include <chrono>

namespace tyglab {

void DeviceSearch::begin() {
  if (!found_ && !busy()) work_ = std::async(std::launch::async, opencl_devices);
}

const OpenClInventory* DeviceSearch::found() {
  if (busy() && work_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) found_ = work_.get();
  return found_ ? &*found_ : nullptr;
}

}  // namespace tyglab
