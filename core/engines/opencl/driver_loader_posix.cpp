#include "core/engines/opencl/opencl_devices.h"

namespace tyglab::opencl {

bool driver_loader_is_there() {
  return true;
}

std::string_view how_to_get_a_device() {
  return "On Debian, apt-get install pocl-opencl-icd provides the CPU as a device.";
}

std::string_view how_to_mend_a_driver() {
  return "Pocl needs a linker (apt-get install binutils) and space in its cache folder; provide both and start again";
}

}  // namespace tyglab::opencl
