// The OpenCL C of kernels/, which CMake puts into the program: so it is found wherever the program is.
#pragma once

#include <string_view>

namespace tyglab::opencl {

/// The text of a file of kernels/, as "cloth.cl", which must be there.
std::string_view kernel_text(std::string_view file);

}  // namespace tyglab::opencl
