// Which OpenGL context devices share buffers with. No header of OpenGL or OpenCL: app hands in what its window has.
#pragma once

#include <cstdint>

namespace tyglab {

/// OpenGL's context as its window system names it.
struct GlContext {
  void *context = nullptr, *display = nullptr;  ///< GLXContext and Display*, or EGLContext and EGLDisplay
  bool glx = false;
  std::uint64_t number = 0;  ///< tells it from others that stood at the same address; GlContextInUse gives it
};

/// While it lives, devices that are opened share buffers with that context, if they can, unless a later one is there.
class GlContextInUse {
 public:
  explicit GlContextInUse(GlContext context);
  ~GlContextInUse();
  GlContextInUse(const GlContextInUse&) = delete;
  GlContextInUse& operator=(const GlContextInUse&) = delete;

 private:
  std::uint64_t number_;
};

/// The one in use; number 0: none is.
GlContext gl_context_in_use();

}  // namespace tyglab
