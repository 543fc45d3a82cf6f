// The OpenGL context with which devices share buffers. It includes no header of OpenGL or OpenCL; app provides the
// handles of its window.
#pragma once

#include <cstdint>

namespace tyglab {

/// An OpenGL context by the handles of its window system.
struct GlContext {
  void *context = nullptr, *display = nullptr;  ///< GLXContext and Display*, or EGLContext and EGLDisplay
  bool glx = false;
  std::uint64_t number = 0;  ///< set by GlContextInUse, since another context may get the same address
};

/// While it exists, newly opened devices share buffers with that context if they can. The latest one counts.
class GlContextInUse {
 public:
  explicit GlContextInUse(GlContext context);
  ~GlContextInUse();
  GlContextInUse(const GlContextInUse&) = delete;
  GlContextInUse& operator=(const GlContextInUse&) = delete;

 private:
  std::uint64_t number_;
};

/// The one in use; its number is 0 if there is none.
GlContext gl_context_in_use();

}  // namespace tyglab
