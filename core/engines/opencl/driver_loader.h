// The library that finds OpenCL drivers, and the advice if it or a driver is missing, for each system.
#pragma once

#include <string_view>

namespace tyglab::opencl {

/// Whether the library is there; until it has been found no function of OpenCL may be called. The program is linked
/// with it on Linux, and takes it at run time on Windows, where a graphics driver brings it.
bool driver_loader_is_there();

/// How one gets a device, a sentence.
std::string_view how_to_get_a_device();
/// What to do where a driver fails at what it should be able to do: an instruction without its full stop.
std::string_view how_to_mend_a_driver();

}  // namespace tyglab::opencl
