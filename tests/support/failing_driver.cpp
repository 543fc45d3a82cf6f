// A layer of the OpenCL loader (OPENCL_LAYERS names the module) whose driver fails from the n-th call on, as one does
// whose device is lost. Calls that give something back are passed on and not counted: a program cannot do anything
// about one that fails.
#define CL_TARGET_OPENCL_VERSION 300
#include "tests/support/failing_driver.h"

#include <CL/cl_layer.h>

#include <array>
#include <atomic>
#include <cstring>
#include <tuple>
#include <type_traits>

namespace {

const cl_icd_dispatch* below;
cl_icd_dispatch mine;
std::atomic<std::int64_t> calls = 0, first_failing = 0;

/// Drivers say it in different words.
cl_int error_of(std::int64_t call) {
  constexpr std::array<cl_int, 3> words{CL_OUT_OF_RESOURCES, CL_DEVICE_NOT_AVAILABLE, CL_MEM_OBJECT_ALLOCATION_FAILURE};
  return words[std::size_t(call) % words.size()];
}

/// The error of a call that fails, or success.
cl_int verdict() {
  const std::int64_t call = ++calls, first = first_failing;
  return first > 0 && call >= first ? error_of(first) : CL_SUCCESS;
}

/// An entry of the table: its own type is that of the function.
template <auto Entry, class Function>
struct Counted;

template <auto Entry, class Result, class... Arguments>
struct Counted<Entry, Result (*)(Arguments...)> {
  static Result CL_API_CALL call(Arguments... arguments) {
    const cl_int code = verdict();
    if (code == CL_SUCCESS) return (below->*Entry)(arguments...);
    if constexpr (std::is_same_v<Result, cl_int>) {
      return code;
    } else {
      cl_int* const out = std::get<sizeof...(Arguments) - 1>(std::tie(arguments...));  // errcode_ret
      if (out != nullptr) *out = code;
      return nullptr;
    }
  }
};

template <auto Entry>
void count() {
  using Function = std::remove_reference_t<decltype(mine.*Entry)>;
  mine.*Entry = &Counted<Entry, Function>::call;
}

}  // namespace

extern "C" void tyglab_fail_driver_from(std::int64_t n) {
  first_failing = n, calls = 0;
}

extern "C" std::int64_t tyglab_driver_calls() {
  return calls;
}

extern "C" cl_int clGetLayerInfo(cl_layer_info what, std::size_t room, void* to, std::size_t* size_to) {
  const cl_layer_api_version version = CL_LAYER_API_VERSION_100;
  if (what != CL_LAYER_API_VERSION || (to != nullptr && room < sizeof version)) return CL_INVALID_VALUE;
  if (to != nullptr) std::memcpy(to, &version, sizeof version);
  if (size_to != nullptr) *size_to = sizeof version;
  return CL_SUCCESS;
}

extern "C" cl_int clInitLayer(cl_uint entries, const cl_icd_dispatch* target, cl_uint* own_entries,
                              const cl_icd_dispatch** own) {
  if (entries < sizeof mine / sizeof(void*)) return CL_INVALID_VALUE;
  below = target;
  mine = *target;
  using Table = cl_icd_dispatch;
  count<&Table::clGetPlatformIDs>(), count<&Table::clGetPlatformInfo>(), count<&Table::clGetDeviceIDs>();
  count<&Table::clGetDeviceInfo>(), count<&Table::clCreateContext>(), count<&Table::clCreateCommandQueue>();
  count<&Table::clCreateBuffer>(), count<&Table::clCreateProgramWithSource>();
  count<&Table::clCreateProgramWithBinary>(), count<&Table::clBuildProgram>(), count<&Table::clGetProgramInfo>();
  count<&Table::clGetProgramBuildInfo>(), count<&Table::clCreateKernel>(), count<&Table::clSetKernelArg>();
  count<&Table::clEnqueueNDRangeKernel>(), count<&Table::clEnqueueReadBuffer>();
  count<&Table::clEnqueueReadBufferRect>(), count<&Table::clEnqueueWriteBuffer>();
  count<&Table::clEnqueueFillBuffer>(), count<&Table::clEnqueueCopyBuffer>(), count<&Table::clEnqueueMapBuffer>();
  count<&Table::clEnqueueUnmapMemObject>(), count<&Table::clFlush>(), count<&Table::clFinish>();
  *own = &mine;
  *own_entries = sizeof mine / sizeof(void*);
  return CL_SUCCESS;
}
