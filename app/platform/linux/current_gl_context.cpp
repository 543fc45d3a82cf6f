#include "app/platform/current_gl_context.h"

#include <EGL/egl.h>

namespace tyglab {

GlContext current_gl_context(void (*(*address)(const char* name))()) {
  if (const EGLContext context = eglGetCurrentContext(); context != EGL_NO_CONTEXT)
    return {.context = context, .display = eglGetCurrentDisplay()};
  // Asked for by name, so that the program needs no GLX where there is none.
  using Getter = void* (*)();
  const auto context = reinterpret_cast<Getter>(address("glXGetCurrentContext"));
  const auto display = reinterpret_cast<Getter>(address("glXGetCurrentDisplay"));
  if (context == nullptr || display == nullptr) return {};
  return {.context = context(), .display = display(), .glx = true};
}

}  // namespace tyglab
