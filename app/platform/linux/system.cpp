
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <glad/gl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "app/platform/platform.h"
#include "app/render/gl_objects.h"

namespace tyglab {

const char* driver_advice() {
  return "Install a driver (on Debian, libgl1-mesa-dri draws on the CPU). Over a remote connection that offers no "
         "OpenGL, use tyglab render and tyglab run, which need no window, or the page in a browser (app/run web).";
}

const char* display_advice() {
  return "Start Tyglab in a desktop session or under xvfb-run, or use tyglab render, which needs no display.";
}

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

void lower_own_priority() {
  setpriority(PRIO_PROCESS, 0, 19);  // on Linux this thread's alone
}

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

/// Software OpenGL keeps its images in the heap and clears each when it is made: at 1280 x 720 some 60 MB, which in
/// pages of 4 kB is a third of a picture's time. Where the system gives larger ones only to who asks, this does.
void ask_for_huge_pages() {
  constexpr int largest_of_heap = 32 << 20, reserve = 64 << 20;
  constexpr std::uintptr_t huge_page = 2 << 20;
  // What is larger has a mapping of its own, and what is given back stays with the heap.
  if (mallopt(M_MMAP_THRESHOLD, largest_of_heap) == 0 || mallopt(M_TRIM_THRESHOLD, 2 * reserve) == 0 ||
      mallopt(M_TOP_PAD, reserve) == 0)
    return;
  void* const first = std::malloc(largest_of_heap / 2);
  const std::uintptr_t past = reinterpret_cast<std::uintptr_t>(first) % huge_page;
  char* const begin = static_cast<char*>(first) + (huge_page - past) % huge_page;
  char* const end = static_cast<char*>(sbrk(0));
  if (first != nullptr && begin < end) madvise(begin, std::size_t(end - begin), MADV_HUGEPAGE);
  std::free(first);
}

}  // namespace

HeadlessContext::HeadlessContext() {
  ask_for_huge_pages();
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
