// Tests whether a device really computes: builds and runs a small kernel and checks its result.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <vector>

#include "core/engines/engine.h"
#include "core/engines/opencl/device.h"
#include "core/engines/opencl/program_text.h"

namespace tyglab {
namespace opencl {
namespace {

/// Runs the probe on points whose neighbors lie 3, 4, 0 away. Returns what is wrong, or nothing.
template <class T>
std::string probe(Device& device, const char* options) {
  const auto program = device.program(std::string(kernel_text("probe.cl")), options);
  const Kernel kernel = program->kernel("probe");
  constexpr int count = 1000;
  std::vector<T> x(3 * count), lengths(count - 1);
  for (int p = 0; p < count; ++p) x[p] = T(3 * p), x[count + p] = T(-4 * p), x[2 * count + p] = T(1);
  const Memory in = device.zeros(x.size() * sizeof(T)), out = device.zeros(lengths.size() * sizeof(T));
  check(clEnqueueWriteBuffer(device.queue(), in.get(), CL_TRUE, 0, x.size() * sizeof(T), x.data(), 0, nullptr, nullptr),
        "writing to the device");
  set_arguments(kernel, 0, in.get(), out.get(), cl_int(count));
  const std::size_t items = count;
  check(clEnqueueNDRangeKernel(device.queue(), kernel.get(), 1, nullptr, &items, nullptr, 0, nullptr, nullptr),
        "starting a kernel");
  check(clEnqueueReadBuffer(device.queue(), out.get(), CL_TRUE, 0, lengths.size() * sizeof(T), lengths.data(), 0,
                            nullptr, nullptr),
        "reading from the device");
  // OpenCL allows sqrt an error of 3 units in the last place.
  const T tolerance = 4 * 5 * std::numeric_limits<T>::epsilon();
  for (const T length : lengths)
    if (!(std::abs(length - T(5)) <= tolerance))
      return "the test kernel gave " + std::to_string(length) + " instead of 5";
  return {};
}

}  // namespace
}  // namespace opencl

bool opencl_works_in_place(int number) {
  constexpr std::size_t page = PositionMemory::page;
  const auto give_back = [](void* memory) { ::operator delete(memory, std::align_val_t(page)); };
  const std::unique_ptr<void, decltype(give_back)> memory(::operator new(page, std::align_val_t(page), std::nothrow),
                                                          give_back);
  try {
    return bool(opencl::open_device(number)->in_place(memory.get(), page));
  } catch (const EngineError&) {
    return false;
  }
}

bool opencl_offers_gl_sharing(int number) {
  const std::vector<OpenClDevice> all = opencl_devices().devices;
  const auto offers = [](const OpenClDevice& device) { return device.gl_sharing && !device.processor; };
  if (number < 0) return std::any_of(all.begin(), all.end(), offers);
  return std::size_t(number) < all.size() && offers(all[std::size_t(number)]);
}

std::string opencl_gl_problem(int number) {
  try {
    return opencl::open_device(number)->gl_problem();
  } catch (const EngineError& error) {
    return error.what();
  }
}

OpenClProbe probe_opencl_device(int number, bool in_double) {
  OpenClProbe result{true, {}};
  try {
    const auto device = opencl::open_device(number);
    result.offered = !in_double || device->facts().fp64;
    if (!result.offered) return result;
    result.problem = in_double ? opencl::probe<double>(*device, "-cl-std=CL1.2 -D REAL=double -D REAL_IS_DOUBLE")
                               : opencl::probe<float>(*device, "-cl-std=CL1.2 -D REAL=float");
  } catch (const EngineError& error) {
    result.problem = error.what();
  }
  return result;
}

}  // namespace tyglab
