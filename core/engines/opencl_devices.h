// Which OpenCL devices there are, and what each really can do.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tyglab {

/// Whether a device computes in one precision.
struct OpenClProbe {
  bool offered = false;  ///< the device says so
  std::string problem;   ///< empty: the probe kernel was built and run, and its result was right
};

struct OpenClDevice {
  std::string platform, name, version, driver;
  unsigned compute_units = 0;
  std::uint64_t memory_bytes = 0;
  bool gl_sharing = false;  ///< cl_khr_gl_sharing: can use OpenGL's buffers
  OpenClProbe float_, double_;
};

struct OpenClInventory {
  std::vector<OpenClDevice> devices;
  std::string problem;  ///< why there is none, if the loader said
};

/// Asks every platform for its devices and runs a probe on each: the OpenCL C text of kernels/probe.cl. Never throws
/// for what a driver does.
OpenClInventory find_opencl_devices(const std::string& probe_source);

}  // namespace tyglab
