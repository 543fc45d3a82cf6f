#include "core/engines/opencl_devices.h"

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#include <CL/opencl.hpp>
#include <cmath>
#include <limits>

namespace tyglab {
namespace {

std::string error_text(const cl::Error& error) {
  constexpr cl_int no_platform = -1001;  // CL_PLATFORM_NOT_FOUND_KHR
  if (error.err() == no_platform) return "no OpenCL driver is installed";
  return std::string(error.what()) + " gave error " + std::to_string(error.err());
}

/// Text of a device or platform, without the closing zero and spaces that some drivers leave.
std::string trimmed(std::string text) {
  const auto last = text.find_last_not_of(std::string("\0 ", 2));
  text.resize(last == std::string::npos ? 0 : last + 1);
  return text;
}

/// The start of the compiler's log: enough to see what is wrong.
std::string build_log(const cl::Program& program, const cl::Device& device) {
  constexpr std::size_t most = 400;
  return "the kernel does not build: " + trimmed(program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device)).substr(0, most);
}

/// Runs the probe on points whose neighbours lie 3, 4, 0 away. Returns what is wrong, or nothing.
template <class T>
std::string probe(const cl::Device& device, const std::string& source, const char* options) {
  const cl::Context context(device);
  const cl::CommandQueue queue(context, device);
  const cl::Program program(context, source);
  try {
    program.build(device, options);
  } catch (const cl::Error&) {
    return build_log(program, device);
  }
  constexpr int count = 1000;
  std::vector<T> x(3 * count), lengths(count - 1);
  for (int p = 0; p < count; ++p) x[p] = T(3 * p), x[count + p] = T(-4 * p), x[2 * count + p] = T(1);
  cl::Buffer in(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, x.size() * sizeof(T), x.data());
  cl::Buffer out(context, CL_MEM_WRITE_ONLY, lengths.size() * sizeof(T));
  cl::Kernel kernel(program, "probe");
  kernel.setArg(0, in);
  kernel.setArg(1, out);
  kernel.setArg(2, cl_int(count));
  queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(count));
  queue.enqueueReadBuffer(out, CL_TRUE, 0, lengths.size() * sizeof(T), lengths.data());
  // OpenCL allows sqrt an error of 3 units in the last place.
  const T tolerance = 4 * 5 * std::numeric_limits<T>::epsilon();
  for (const T length : lengths)
    if (!(std::abs(length - T(5)) <= tolerance))
      return "the test kernel gave " + std::to_string(length) + " where 5 is right";
  return {};
}

template <class T>
OpenClProbe run_probe(const cl::Device& device, const std::string& source, const char* options) {
  OpenClProbe result{true, {}};
  try {
    result.problem = probe<T>(device, source, options);
  } catch (const cl::Error& error) {
    result.problem = error_text(error);
  }
  return result;
}

OpenClDevice examine(const cl::Platform& platform, const cl::Device& device, const std::string& source) {
  OpenClDevice found;
  found.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
  found.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
  found.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
  found.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
  found.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
  found.memory_bytes = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  const std::string extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
  found.gl_sharing = extensions.find("cl_khr_gl_sharing") != std::string::npos;
  found.float_ = run_probe<float>(device, source, "-cl-std=CL1.2 -D REAL=float");
  if (extensions.find("cl_khr_fp64") != std::string::npos)
    found.double_ = run_probe<double>(device, source, "-cl-std=CL1.2 -D REAL=double -D REAL_IS_DOUBLE");
  return found;
}

}  // namespace

OpenClInventory find_opencl_devices(const std::string& probe_source) {
  OpenClInventory inventory;
  try {
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    for (const cl::Platform& platform : platforms) {
      try {
        std::vector<cl::Device> devices;
        platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
        for (const cl::Device& device : devices) inventory.devices.push_back(examine(platform, device, probe_source));
      } catch (const cl::Error& error) {
        // A platform without devices says so by an error; the others still count.
        if (error.err() != CL_DEVICE_NOT_FOUND) inventory.problem = error_text(error);
      }
    }
  } catch (const cl::Error& error) {
    inventory.problem = error_text(error);
  }
  return inventory;
}

}  // namespace tyglab
