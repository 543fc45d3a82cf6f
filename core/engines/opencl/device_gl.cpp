// The connection of a device to OpenGL (cl_khr_gl_sharing). So far tested only with a simulated device, since no
// graphics card was available.
#include <algorithm>
#include <array>
#include <cstddef>

#include "core/engines/opencl/device.h"

namespace tyglab::opencl {

/// A context that shares buffers with OpenGL's; none where that cannot be, and gl_problem_ says why.
Context Device::context_with(cl_platform_id platform, const GlContext& gl) {
  const auto none = [this](const std::string& why) {
    gl_problem_ = why;
    return Context();
  };
  if (!facts_.gl_sharing) return none("the device does not support cl_khr_gl_sharing");
  if (facts_.processor) return none("the device is a CPU, which can use OpenGL's memory anyway");
  if (gl.number == 0) return none("there was no OpenGL context when the device was opened");
  const auto property = [](void* handle) { return reinterpret_cast<cl_context_properties>(handle); };
  const std::array<cl_context_properties, 7> properties{CL_CONTEXT_PLATFORM,
                                                        property(platform),
                                                        CL_GL_CONTEXT_KHR,
                                                        property(gl.context),
                                                        gl.glx ? CL_GLX_DISPLAY_KHR : CL_EGL_DISPLAY_KHR,
                                                        property(gl.display),
                                                        0};
  const auto ask = reinterpret_cast<clGetGLContextInfoKHR_fn>(
      clGetExtensionFunctionAddressForPlatform(platform, "clGetGLContextInfoKHR"));
  if (ask == nullptr) return none("its driver has no clGetGLContextInfoKHR");
  std::array<cl_device_id, 64> sharing{};
  std::size_t bytes = 0;
  cl_int code = ask(properties.data(), CL_DEVICES_FOR_GL_CONTEXT_KHR, sizeof sharing, sharing.data(), &bytes);
  const auto end = sharing.begin() + std::ptrdiff_t(std::min(bytes, sizeof sharing) / sizeof(cl_device_id));
  if (code != CL_SUCCESS || std::find(sharing.begin(), end, id_) == end) return none("OpenGL draws on another device");
  Context context(clCreateContext(properties.data(), 1, &id_, nullptr, nullptr, &code));
  if (code != CL_SUCCESS) return none("its driver refuses a context shared with OpenGL, " + words_of(code));
  return context;
}

GlSharing Device::gl_sharing() const {
  if (!gl_problem_.empty() || gl_number_ != gl_context_in_use().number) return GlSharing::none;
  return facts_.gl_event ? GlSharing::ordered : GlSharing::finished;
}

Memory Device::shared(unsigned gl_name) const {
  cl_int code = CL_SUCCESS;
  Memory memory(clCreateFromGLBuffer(context_.get(), CL_MEM_READ_WRITE, gl_name, &code));
  check(code, "sharing a buffer with OpenGL");
  return memory;
}

}  // namespace tyglab::opencl
