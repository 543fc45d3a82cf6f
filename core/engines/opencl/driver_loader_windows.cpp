#include <windows.h>

#include "core/engines/opencl/opencl_devices.h"

namespace tyglab::opencl {

// OpenCL.dll is linked with "delayed": its functions are looked up when they are called first, which ends the program
// where the library is missing. From the system's folder alone, since a program's own folder may be anybody's.
bool driver_loader_is_there() {
  static const bool there = ::LoadLibraryExW(L"OpenCL.dll", nullptr, LOAD_LIBRARY_SEARCH_SYSTEM32) != nullptr;
  return there;
}

std::string_view how_to_get_a_device() {
  return "The driver of a graphics card provides a device.";
}

std::string_view how_to_mend_a_driver() {
  return "Install the newest driver of the graphics card and start again";
}

}  // namespace tyglab::opencl
