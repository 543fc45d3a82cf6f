#include "app/platform/platform.h"

#include <glad/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

#include "app/platform/gl/dialect.h"
#include "app/process/process.h"
#include "app/render/gl_objects.h"
#include "backends/imgui_impl_glfw.h"

namespace tyglab {
namespace {

constexpr int tall_monitor = 1400;           // pixels
constexpr glm::ivec2 first_size{1440, 860};  // at scale 1

std::string glfw_problem() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text != nullptr ? text : "no reason was given";
}

InputQueue& queue_of(GLFWwindow* window) {
  return *static_cast<InputQueue*>(glfwGetWindowUserPointer(window));
}

void on_key(GLFWwindow* window, int key, int, int action, int mods) {
  queue_of(window).on_key(key, action, mods);
}

void on_character(GLFWwindow* window, unsigned code) {
  queue_of(window).on_character(code);
}

void on_button(GLFWwindow* window, int button, int action, int mods) {
  queue_of(window).on_button(button, action, mods, glfwGetTime());
}

void on_move(GLFWwindow* window, double x, double y) {
  queue_of(window).on_move({x, y}, glfwGetTime());
}

void on_wheel(GLFWwindow* window, double x, double y) {
  queue_of(window).on_wheel({x, y}, glfwGetTime());
}

void on_focus(GLFWwindow* window, int focused) {
  queue_of(window).focused = focused != 0;
  queue_of(window).anything = true;
}

void on_enter(GLFWwindow* window, int entered) {
  queue_of(window).inside = entered != 0;
  queue_of(window).anything = true;
}

void on_drop(GLFWwindow* window, int count, const char** files) {
  InputQueue& queue = queue_of(window);
  queue.anything = true;
  for (int k = 0; k < count; ++k) queue.dropped.emplace_back(files[k]);
}

/// Whether a window at that place would be seen on some monitor.
bool on_a_monitor(int x, int y) {
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  for (int k = 0; k < count; ++k) {
    int left = 0, top = 0, width = 0, height = 0;
    glfwGetMonitorWorkarea(monitors[k], &left, &top, &width, &height);
    if (x >= left - 8 && x < left + width - 100 && y >= top - 8 && y < top + height - 60) return true;
  }
  return false;
}

glm::ivec2 fit_to_screen(int width, int height) {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  if (monitor == nullptr) return {width, height};
  int x = 0, y = 0, most_width = 0, most_height = 0;
  glfwGetMonitorWorkarea(monitor, &x, &y, &most_width, &most_height);
  if (most_width <= 0 || most_height <= 0) return {width, height};
  return {std::min(width, most_width), std::min(height, most_height)};
}

bool start_glfw() {
#ifdef GLFW_PLATFORM
  // GLFW 3.4 looks for a Wayland compositor first, and where there is none libwayland complains on stderr.
  if (std::getenv("WAYLAND_DISPLAY") == nullptr && std::getenv("WAYLAND_SOCKET") == nullptr)
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
  return glfwInit() == GLFW_TRUE;
}

const GLFWvidmode* video_mode() {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  return monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
}

void install_callbacks(GLFWwindow* window) {
  glfwSetKeyCallback(window, on_key);
  glfwSetCharCallback(window, on_character);
  glfwSetMouseButtonCallback(window, on_button);
  glfwSetCursorPosCallback(window, on_move);
  glfwSetScrollCallback(window, on_wheel);
  glfwSetDropCallback(window, on_drop);
  glfwSetWindowFocusCallback(window, on_focus);
  glfwSetCursorEnterCallback(window, on_enter);
  const auto anything = [](GLFWwindow* of) { queue_of(of).anything = true; };
  glfwSetWindowRefreshCallback(window, anything);
  glfwSetWindowCloseCallback(window, anything);
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* of, int, int) { queue_of(of).anything = true; });
  glfwSetWindowContentScaleCallback(
      window, [](GLFWwindow* of, float, float) { queue_of(of).scale_changed = queue_of(of).anything = true; });
}

}  // namespace

bool display_there() {
  // Without a display's name GLFW is not asked: its libraries complain on stderr.
  return display_is_named() && start_glfw();
}

bool prefers_light() {
  return false;
}

bool prefers_little_motion() {
  return false;
}

double window_time() {
  return glfwGetTime();
}

struct Window::Parts {
  struct Place {
    int x = 0, y = 0, width = 1280, height = 720;
  };
  static Place place_of(GLFWwindow* window) {
    Place place;
    glfwGetWindowPos(window, &place.x, &place.y);
    glfwGetWindowSize(window, &place.width, &place.height);
    return place;
  }

  GLFWwindow* window = nullptr;
  std::optional<GlContextInUse> gl_in_use = {};  ///< OpenCL devices that are opened share buffers with it, if they can
  Place windowed = {};
  std::string title = {};
};

Window::Window(int width, int height, const Settings& settings, InputQueue& queue) : parts_(std::make_unique<Parts>()) {
  if (!start_glfw())
    throw GraphicsError("There is no display for a window (" + glfw_problem() + "). " + display_advice());
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  const bool given = width > 0 && height > 0;
  const bool first = !given && (settings.width == 0 || settings.height == 0);
  const glm::ivec2 size = given   ? glm::ivec2(width, height)
                          : first ? fit_to_screen(first_size.x, first_size.y)
                                  : fit_to_screen(settings.width, settings.height);
  GLFWwindow*& window = parts_->window;
  window = glfwCreateWindow(size.x, size.y, "Tyglab", nullptr, nullptr);
  if (window == nullptr) {
    const std::string problem = glfw_problem();
    // A remote X server may have no GLX.
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, GLFW_EGL_CONTEXT_API);
    window = glfwCreateWindow(size.x, size.y, "Tyglab", nullptr, nullptr);
    if (window == nullptr) {
      glfwTerminate();
      throw GraphicsError("A window with OpenGL 3.3 could not be opened (" + problem + "). " + driver_advice());
    }
  }
  if (first) {
    const glm::ivec2 scaled = glm::vec2(first_size) * content_scale();
    const glm::ivec2 fitting = fit_to_screen(scaled.x, scaled.y);
    glfwSetWindowSize(window, fitting.x, fitting.y);
  }
  glfwSetWindowSizeLimits(window, 480, 320, GLFW_DONT_CARE, GLFW_DONT_CARE);
  if (!given && settings.x >= 0 && on_a_monitor(settings.x, settings.y))
    glfwSetWindowPos(window, settings.x, settings.y);
  if (!given && settings.maximised) glfwMaximizeWindow(window);
  glfwMakeContextCurrent(window);
  if (gladLoadGL(glfwGetProcAddress) == 0) {
    glfwDestroyWindow(window);
    glfwTerminate();
    throw GraphicsError(std::string("The functions of OpenGL 3.3 could not be loaded. ") + driver_advice());
  }
  parts_->gl_in_use.emplace(current_gl_context(glfwGetProcAddress));
  glfwSetWindowUserPointer(window, &queue);
  install_callbacks(window);
  queue.focused = glfwGetWindowAttrib(window, GLFW_FOCUSED) != 0;
  queue.inside = glfwGetWindowAttrib(window, GLFW_HOVERED) != 0;
  glfwShowWindow(window);
  parts_->windowed = Parts::place_of(window);
}

Window::~Window() {
  parts_->gl_in_use.reset();
  glfwDestroyWindow(parts_->window);
  glfwTerminate();
}

void Window::take_events(double wait) {
  wait > 0 ? glfwWaitEventsTimeout(wait) : glfwPollEvents();
}

void Window::swap() {
  glfwSwapBuffers(parts_->window);
}

void Window::wait_for_screen(bool waits) {
  glfwSwapInterval(waits ? 1 : 0);
}

bool Window::wants_close() const {
  return glfwWindowShouldClose(parts_->window) != 0;
}

void Window::forget_close() {
  glfwSetWindowShouldClose(parts_->window, GLFW_FALSE);
}

bool Window::hidden() const {
  return glfwGetWindowAttrib(parts_->window, GLFW_ICONIFIED) != 0;
}

bool Window::full_screen() const {
  return glfwGetWindowMonitor(parts_->window) != nullptr;
}

void Window::set_title(const std::string& title) {
  if (title == parts_->title) return;
  parts_->title = title;
  glfwSetWindowTitle(parts_->window, title.c_str());
}

void Window::tell(const std::string&, const std::string&) {}

void Window::toggle_full_screen() {
  const Parts::Place& old = parts_->windowed;
  if (full_screen()) {
    glfwSetWindowMonitor(parts_->window, nullptr, old.x, old.y, old.width, old.height, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  parts_->windowed = Parts::place_of(parts_->window);
  glfwSetWindowMonitor(parts_->window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

glm::ivec2 Window::size() const {
  glm::ivec2 size{0};
  glfwGetWindowSize(parts_->window, &size.x, &size.y);
  return size;
}

glm::ivec2 Window::framebuffer_size() const {
  glm::ivec2 size{0};
  glfwGetFramebufferSize(parts_->window, &size.x, &size.y);
  return size;
}

float Window::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(parts_->window, &x, &y);
  const glm::ivec2 window = size(), framebuffer = framebuffer_size();
  // Where window coordinates are larger than pixels (Wayland), the system magnifies them already.
  const float magnified = window.x > 0 ? float(framebuffer.x) / float(window.x) : 1;
  float scale = magnified > 0 ? x / magnified : x;
  const GLFWvidmode* const mode = video_mode();
  if (x == 1 && mode != nullptr && mode->height >= tall_monitor) scale *= 1.25f;
  return std::isfinite(scale) ? std::clamp(scale, 0.5f, 4.f) : 1;
}

double Window::frame_time() const {
  const GLFWvidmode* const mode = video_mode();
  return 1.0 / (mode != nullptr && mode->refreshRate >= 30 ? mode->refreshRate : 60);
}

void Window::remember(Settings& settings) const {
  settings.maximised = glfwGetWindowAttrib(parts_->window, GLFW_MAXIMIZED) != 0;
  if (settings.maximised) return;
  const Parts::Place now = full_screen() ? parts_->windowed : Parts::place_of(parts_->window);
  settings.x = now.x, settings.y = now.y, settings.width = now.width, settings.height = now.height;
}

Image Window::pixels() const {
  const glm::ivec2 size = framebuffer_size();
  glReadBuffer(GL_BACK);
  return {size.x, size.y, read_pixels(size.x, size.y)};
}

GuiBackend::GuiBackend(Window& window) {
  ImGui_ImplGlfw_InitForOpenGL(window.parts_->window, false);  // it has its events from the input queue
}

GuiBackend::~GuiBackend() {
  ImGui_ImplGlfw_Shutdown();
}

void GuiBackend::begin_frame() {
  ImGui_ImplGlfw_NewFrame();
}

}  // namespace tyglab
