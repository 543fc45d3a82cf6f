#include "app/shell/window.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "app/render/current_gl_context.h"
#include "app/render/graphics_error.h"
#include "app/ui/kit/imgui_compat.h"
#include "backends/imgui_impl_glfw.h"
#include "backends/imgui_impl_opengl3.h"

namespace tyglab {
namespace {

constexpr int tall_monitor = 1400;  // pixels

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

}  // namespace

bool start_glfw() {
#ifdef GLFW_PLATFORM
  // GLFW 3.4 looks for a Wayland compositor first, and where there is none libwayland complains on stderr.
  if (std::getenv("WAYLAND_DISPLAY") == nullptr && std::getenv("WAYLAND_SOCKET") == nullptr)
    glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
  return glfwInit() == GLFW_TRUE;
}

Window::Window(int width, int height, const Settings& settings, InputQueue& queue) {
  if (!start_glfw())
    throw GraphicsError(
        "There is no display for a window (" + glfw_problem() +
        "). Start Tyglab in a desktop session or under xvfb-run, or use tyglab render, which needs no display.");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
  const bool given = width > 0 && height > 0;
  const glm::ivec2 size = given ? glm::ivec2(width, height) : fit_to_screen(settings.width, settings.height);
  window_ = glfwCreateWindow(size.x, size.y, "Tyglab", nullptr, nullptr);
  if (window_ == nullptr) {
    const std::string problem = glfw_problem();
    glfwTerminate();
    throw GraphicsError("A window with OpenGL 3.3 could not be opened (" + problem +
                        "). Install a driver (on Debian, libgl1-mesa-dri draws on the CPU).");
  }
  glfwSetWindowSizeLimits(window_, 480, 320, GLFW_DONT_CARE, GLFW_DONT_CARE);
  if (!given && settings.x >= 0 && on_a_monitor(settings.x, settings.y))
    glfwSetWindowPos(window_, settings.x, settings.y);
  if (!given && settings.maximised) glfwMaximizeWindow(window_);
  glfwMakeContextCurrent(window_);
  if (gladLoadGL(glfwGetProcAddress) == 0) {
    glfwDestroyWindow(window_);
    glfwTerminate();
    throw GraphicsError("The functions of OpenGL 3.3 could not be loaded. Install a driver (libgl1-mesa-dri).");
  }
  gl_in_use_.emplace(current_gl_context(glfwGetProcAddress));
  glfwSetWindowUserPointer(window_, &queue);
  install_callbacks();
  queue.focused = glfwGetWindowAttrib(window_, GLFW_FOCUSED) != 0;
  queue.inside = glfwGetWindowAttrib(window_, GLFW_HOVERED) != 0;
  glfwShowWindow(window_);
  windowed_ = place();
}

Window::~Window() {
  gl_in_use_.reset();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

void Window::install_callbacks() {
  glfwSetKeyCallback(window_, on_key);
  glfwSetCharCallback(window_, on_character);
  glfwSetMouseButtonCallback(window_, on_button);
  glfwSetCursorPosCallback(window_, on_move);
  glfwSetScrollCallback(window_, on_wheel);
  glfwSetDropCallback(window_, on_drop);
  glfwSetWindowFocusCallback(window_, on_focus);
  glfwSetCursorEnterCallback(window_, on_enter);
  const auto anything = [](GLFWwindow* window) { queue_of(window).anything = true; };
  glfwSetWindowRefreshCallback(window_, anything);
  glfwSetWindowCloseCallback(window_, anything);
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { queue_of(window).anything = true; });
  glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* window, float, float) {
    queue_of(window).scale_changed = queue_of(window).anything = true;
  });
}

void Window::set_title(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

Window::Place Window::place() const {
  Place place;
  glfwGetWindowPos(window_, &place.x, &place.y);
  glfwGetWindowSize(window_, &place.width, &place.height);
  return place;
}

void Window::toggle_full_screen() {
  if (full_screen()) {
    glfwSetWindowMonitor(window_, nullptr, windowed_.x, windowed_.y, windowed_.width, windowed_.height, GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (mode == nullptr) return;
  windowed_ = place();
  glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

glm::ivec2 Window::size() const {
  glm::ivec2 size{0};
  glfwGetWindowSize(window_, &size.x, &size.y);
  return size;
}

glm::ivec2 Window::framebuffer_size() const {
  glm::ivec2 size{0};
  glfwGetFramebufferSize(window_, &size.x, &size.y);
  return size;
}

float Window::content_scale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  const glm::ivec2 window = size(), framebuffer = framebuffer_size();
  // Where window coordinates are larger than pixels (Wayland), the system magnifies them already.
  const float magnified = window.x > 0 ? float(framebuffer.x) / float(window.x) : 1;
  float scale = magnified > 0 ? x / magnified : x;
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  if (x == 1 && mode != nullptr && mode->height >= tall_monitor) scale *= 1.25f;
  return std::isfinite(scale) ? std::clamp(scale, 0.5f, 4.f) : 1;
}

double Window::frame_time() const {
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
  return 1.0 / (mode != nullptr && mode->refreshRate >= 30 ? mode->refreshRate : 60);
}

void Window::remember(Settings& settings) const {
  settings.maximised = glfwGetWindowAttrib(window_, GLFW_MAXIMIZED) != 0;
  if (settings.maximised) return;
  const Place now = full_screen() ? windowed_ : place();
  settings.x = now.x, settings.y = now.y, settings.width = now.width, settings.height = now.height;
}

Image Window::pixels() const {
  const glm::ivec2 size = framebuffer_size();
  Image image{size.x, size.y, std::vector<std::uint8_t>(std::size_t(size.x) * size.y * 3)};
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadBuffer(GL_BACK);
  glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  const std::size_t row = std::size_t(size.x) * 3;
  for (int y = 0; y < size.y / 2; ++y)
    std::swap_ranges(image.rgb.begin() + std::ptrdiff_t(y * row), image.rgb.begin() + std::ptrdiff_t((y + 1) * row),
                     image.rgb.begin() + std::ptrdiff_t((size.y - 1 - y) * row));
  return image;
}

Gui::Gui(GLFWwindow* window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  gui::prepare_io(ImGui::GetIO());
  ImGui_ImplGlfw_InitForOpenGL(window, false);  // it has its events from the input queue
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Gui::begin_frame(InputQueue& input) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  input_.feed(input);
  ImGui::NewFrame();
}

void Gui::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Gui::fonts_changed() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
  ImGui::GetIO().Fonts->ClearTexData();  // OpenGL has it
}

}  // namespace tyglab
