// Arguments of kernels. Include this only in this folder.
#pragma once

#include "core/engines/opencl/handles.h"

namespace tyglab::opencl {

/// Sets consecutive arguments from number `at` on; returns the number of the next.
template <class... T>
int set_arguments(const Kernel& kernel, int at, const T&... values) {
  // Buffers are arguments as their handles, which are pointers.
  // NOLINTNEXTLINE(bugprone-sizeof-expression)
  (check(clSetKernelArg(kernel.get(), cl_uint(at++), sizeof values, &values), "setting an argument"), ...);
  return at;
}

}  // namespace tyglab::opencl
