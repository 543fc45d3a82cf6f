// The current OpenGL context, in the form that OpenCL requires.
#pragma once

#include "core/engines/opencl/gl_context.h"

namespace tyglab {

/// Of this thread. `address`: finds the window system's functions by their names. Without a context, or under another
/// window system than EGL or GLX, its `context` is null.
GlContext current_gl_context(void (*(*address)(const char* name))());

}  // namespace tyglab
