// Finds out in a child process, where these exist, whether an OpenCL driver crashes when asked for its devices.
#pragma once

namespace tyglab {

/// Has core ask the drivers in a child process first (set_driver_probe()). On Windows they are asked in this
/// process.
void probe_drivers_in_child();

}  // namespace tyglab
