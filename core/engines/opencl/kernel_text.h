// The OpenCL C of kernels/, which CMake compiles into the program, so no file has to be found at run time.
#pragma once

#include <string_view>

namespace tyglab::opencl {

/// The text of a file of kernels/, such as "cloth.cl", which must exist.
std::string_view kernel_text(std::string_view file);

}  // namespace tyglab::opencl
