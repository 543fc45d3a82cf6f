// Which OpenCL devices there are, asked once and beside the frames: drivers take their time, and some fail.
#pragma once

#include <future>
#include <optional>

#include "core/engines/opencl/opencl_devices.h"

namespace tyglab {

class DeviceSearch {
 public:
  /// Begins, the first time that it is called.
  void begin();
  bool busy() const { return work_.valid(); }
  /// What there is; null until that is known.
  const OpenClInventory* found();

 private:
  std::future<OpenClInventory> work_;
  std::optional<OpenClInventory> found_;
};

}  // namespace tyglab
