#include "core/engines/opencl/device.h"

namespace tyglab::opencl {

bool driver_loader_is_there() {
  return true;
}

std::string_view how_to_get_a_device() {
  return "On Debian, apt-get install pocl-opencl-icd makes the CPU one.";
}

std::string_view how_to_mend_a_driver() {
  return "Pocl needs a linker (apt-get install binutils) and room in its cache folder; mend that and start again";
}

}  // namespace tyglab::opencl
