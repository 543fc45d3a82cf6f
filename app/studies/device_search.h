// Lists the OpenCL devices, once and in the background, because drivers are slow and some fail.
#pragma once

#include <optional>

#include "app/studies/job.h"
#include "core/engines/opencl/opencl_devices.h"

namespace tyglab {

class DeviceSearch {
 public:
  /// Begins, the first time that it is called.
  void begin();
  bool busy() const { return work_.busy(); }
  /// What there is; null until that is known.
  const OpenClInventory* found();

 private:
  Job<OpenClInventory> work_;
  std::optional<OpenClInventory> found_;
};

}  // namespace tyglab
