// OpenGL without a window or a display.
#pragma once

#include <optional>

#include "core/engines/opencl/gl_context.h"

namespace tyglab {

/// An OpenGL 3.3 core context on EGL's surfaceless platform (Mesa), or of a hidden window of Windows, current in this
/// thread while the object lives. OpenCL devices that are opened meanwhile share buffers with it, if they can.
class HeadlessContext {
 public:
  /// Makes it and loads the functions. Throws GraphicsError that says what to install.
  HeadlessContext();
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::optional<GlContextInUse> in_use_;
};

}  // namespace tyglab
