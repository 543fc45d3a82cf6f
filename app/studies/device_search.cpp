#include "app/studies/device_search.h"

namespace tyglab {

void DeviceSearch::begin() {
  if (!found_ && !busy()) work_.start(Priority::normal, [](const JobControl&) { return opencl_devices(); });
}

const OpenClInventory* DeviceSearch::found() {
  if (work_.ready()) {
    auto outcome = work_.take();
    auto* inventory = std::get_if<OpenClInventory>(&outcome);
    found_ = inventory != nullptr ? std::move(*inventory) : OpenClInventory{{}, std::get<JobError>(outcome).what};
  }
  return found_ ? &*found_ : nullptr;
}

}  // namespace tyglab
