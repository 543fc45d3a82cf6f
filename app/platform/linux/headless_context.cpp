#include "app/platform/headless_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <glad/gl.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "app/platform/current_gl_context.h"
#include "app/render/graphics_error.h"

namespace tyglab {
namespace {

[[noreturn]] void fail(const std::string& what) {
  char code[16];
  std::snprintf(code, sizeof code, "0x%04X", unsigned(eglGetError()));
  throw GraphicsError(what + " (EGL error " + code +
                      "). Drawing without a display needs Mesa: apt-get install libegl1 libgl1-mesa-dri");
}

EGLDisplay surfaceless_display() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (extensions == nullptr || std::strstr(extensions, "EGL_MESA_platform_surfaceless") == nullptr) {
    fail("this EGL has no surfaceless platform");
  }
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (get_display == nullptr) fail("EGL cannot open a platform display");
  return get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
}

EGLContext core_context(EGLDisplay display) {
  const EGLint config_wish[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (!eglChooseConfig(display, config_wish, &config, 1, &configs) || configs == 0) config = EGL_NO_CONFIG_KHR;
  const EGLint wish[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  return eglCreateContext(display, config, EGL_NO_CONTEXT, wish);
}

}  // namespace

HeadlessContext::HeadlessContext() {
  display_ = surfaceless_display();
  if (display_ == EGL_NO_DISPLAY || !eglInitialize(display_, nullptr, nullptr)) fail("EGL could not be started");
  if (!eglBindAPI(EGL_OPENGL_API)) fail("EGL offers no OpenGL");
  context_ = core_context(display_);
  if (context_ == EGL_NO_CONTEXT) fail("OpenGL 3.3 core is not available");
  if (!eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_)) {
    eglDestroyContext(display_, context_);
    fail("The OpenGL context cannot be used without a window");
  }
  if (gladLoadGL(eglGetProcAddress) == 0) fail("The OpenGL functions could not be loaded");
  in_use_.emplace(current_gl_context(eglGetProcAddress));
}

HeadlessContext::~HeadlessContext() {
  in_use_.reset();
  // The display is shared by the process and is left initialized for the next context.
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

}  // namespace tyglab
