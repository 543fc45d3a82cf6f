// OpenCL objects as owning types, and OpenCL error codes as exceptions. It uses the C interface, since the C++
// interface takes as long to compile as the whole engine. Include this only in this folder.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <CL/cl_gl.h>

#include <string>
#include <utility>

#include "core/engines/engine.h"

namespace tyglab::opencl {

/// For display, such as "the device is out of resources, or was lost (error -5)".
std::string words_of(cl_int code);

/// Throws EngineError, "what: why" and what to do, unless the code is CL_SUCCESS.
void check(cl_int code, const char* what);

/// Owns one object.
template <class T, cl_int (*release)(T)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(T object) : object_(object) {}
  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Handle() {
    if (object_ != nullptr) release(object_);
  }
  T get() const { return object_; }
  explicit operator bool() const { return object_ != nullptr; }

 private:
  T object_ = nullptr;
};
using Context = Handle<cl_context, clReleaseContext>;
using Queue = Handle<cl_command_queue, clReleaseCommandQueue>;
using ProgramHandle = Handle<cl_program, clReleaseProgram>;
using Kernel = Handle<cl_kernel, clReleaseKernel>;
using Memory = Handle<cl_mem, clReleaseMemObject>;

}  // namespace tyglab::opencl
