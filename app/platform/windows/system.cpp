
#include <glad/gl.h>
#include <windows.h>
#include <string>

#include "app/platform/platform.h"
#include "app/render/gl_objects.h"

namespace tyglab {

const char* driver_advice() {
  return "Install the newest driver from the maker of the graphics card. Remote desktops and virtual machines often "
         "have none; all commands but tyglab render work without it (tyglab --help).";
}

const char* display_advice() {
  return "Start Tyglab in a desktop session, or use its commands (tyglab --help).";
}

GlContext current_gl_context(void (*(*)(const char* name))()) {
  return {};  // buffers are shared under EGL and GLX alone; here positions are copied
}

void lower_own_priority() {
  ::SetThreadPriority(::GetCurrentThread(), THREAD_PRIORITY_LOWEST);
}

namespace {

// Of the extension WGL_ARB_create_context, which makes contexts of a version.
constexpr int major_version = 0x2091, minor_version = 0x2092, profile_mask = 0x9126, core_profile = 1;
using MakeContext = HGLRC(WINAPI*)(HDC, HGLRC, const int*);

[[noreturn]] void fail(const std::string& what) {
  throw GraphicsError(what + " (Windows error " + std::to_string(::GetLastError()) +
                      "). Drawing needs a graphics driver with OpenGL 3.3; install the newest driver from the maker of "
                      "the graphics card");
}

/// A window that is never shown, since Windows makes contexts for windows alone.
HWND hidden_window() {
  const wchar_t* name = L"TyglabHidden";
  WNDCLASSW kind = {};
  kind.style = CS_OWNDC, kind.lpfnWndProc = ::DefWindowProcW, kind.hInstance = ::GetModuleHandleW(nullptr);
  kind.lpszClassName = name;
  ::RegisterClassW(&kind);  // fails, as it may, the second time
  return ::CreateWindowExW(0, name, L"", WS_OVERLAPPED, 0, 0, 16, 16, nullptr, nullptr, kind.hInstance, nullptr);
}

void choose_format(HDC device) {
  PIXELFORMATDESCRIPTOR wish = {};
  wish.nSize = sizeof wish, wish.nVersion = 1;
  wish.dwFlags = PFD_DRAW_TO_WINDOW | PFD_SUPPORT_OPENGL | PFD_DOUBLEBUFFER;
  wish.iPixelType = PFD_TYPE_RGBA, wish.cColorBits = 32, wish.cDepthBits = 24;
  const int format = ::ChoosePixelFormat(device, &wish);
  if (format == 0 || ::SetPixelFormat(device, format, &wish) == 0) fail("OpenGL is not available");
}

HGLRC core_context(HDC device) {
  // An old context, to ask for the function that makes new ones.
  const HGLRC old = ::wglCreateContext(device);
  if (old == nullptr || ::wglMakeCurrent(device, old) == 0) fail("OpenGL could not be started");
  const auto make =
      reinterpret_cast<MakeContext>(reinterpret_cast<void*>(::wglGetProcAddress("wglCreateContextAttribsARB")));
  const int wish[] = {major_version, 3, minor_version, 3, profile_mask, core_profile, 0};
  const HGLRC context = make != nullptr ? make(device, nullptr, wish) : nullptr;
  ::wglMakeCurrent(nullptr, nullptr);
  ::wglDeleteContext(old);
  return context;
}

GLADapiproc address_of(const char* name) {
  // Those of OpenGL 1.1 are in the library itself, where the function for the others does not find them.
  static const HMODULE library = ::LoadLibraryW(L"opengl32.dll");
  if (auto* const newer = ::wglGetProcAddress(name); newer != nullptr) return reinterpret_cast<GLADapiproc>(newer);
  return reinterpret_cast<GLADapiproc>(::GetProcAddress(library, name));
}

}  // namespace

HeadlessContext::HeadlessContext() {
  const HWND window = hidden_window();
  if (window == nullptr) fail("A window could not be created");
  display_ = window;
  const HDC device = ::GetDC(window);
  try {
    choose_format(device);
    const HGLRC context = core_context(device);
    if (context == nullptr) fail("OpenGL 3.3 core is not available");
    context_ = context;
    if (::wglMakeCurrent(device, context) == 0 || gladLoadGL(address_of) == 0)
      fail("The OpenGL functions could not be loaded");
  } catch (const GraphicsError&) {
    if (context_ != nullptr) ::wglDeleteContext(static_cast<HGLRC>(context_));
    ::DestroyWindow(window);
    throw;
  }
  in_use_.emplace(current_gl_context(address_of));
}

HeadlessContext::~HeadlessContext() {
  in_use_.reset();
  ::wglMakeCurrent(nullptr, nullptr);
  ::wglDeleteContext(static_cast<HGLRC>(context_));
  ::DestroyWindow(static_cast<HWND>(display_));
}

}  // namespace tyglab
