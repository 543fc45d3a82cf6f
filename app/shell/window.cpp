#include "app/shell/window.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
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
  InputQueue& queue = queue_of(window);
  queue.anything = true;
  if (action != GLFW_RELEASE) queue.keys.push_back({key, mods, action == GLFW_REPEAT});
  // GLFW tells the modifiers as they were before a modifier key itself changed.
  const auto track = [&](int left, int right, int bit) {
    if (key == left || key == right) mods = action == GLFW_RELEASE ? mods & ~bit : mods | bit;
  };
  track(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT);
  track(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL);
  track(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, GLFW_MOD_ALT);
  queue.mods = mods;
}

/// Whether a press does nothing but type a character. Dear ImGui needs such keys only as text; shown as keys too, they
/// would take it a frame each.
bool only_types(int key, int mods) {
  return key < GLFW_KEY_ESCAPE && (mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) == 0;
}

/// In place of the backend's callback, which calls on_key itself.
void on_key_for_gui(GLFWwindow* window, int key, int scancode, int action, int mods) {
  if (action != GLFW_RELEASE && only_types(key, mods)) return on_key(window, key, scancode, action, mods);
  ImGui_ImplGlfw_KeyCallback(window, key, scancode, action, mods);
}

#if IMGUI_VERSION_NUM < 18700
void on_character(GLFWwindow* window, unsigned character) {
  InputQueue& queue = queue_of(window);
  queue.anything = true;
  queue.text.push_back({character, queue.keys.size()});
}
#endif

void on_button(GLFWwindow* window, int button, int action, int mods) {
  InputQueue& queue = queue_of(window);
  queue.anything = true;
  queue.mods = mods;
  if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS) queue.note_left_press(glfwGetTime());
  const auto type = action == GLFW_PRESS ? PointerEvent::Type::press : PointerEvent::Type::release;
  queue.pointer.push_back({type, button, mods, queue.at, {0, 0}, glfwGetTime()});
}

void on_move(GLFWwindow* window, double x, double y) {
  InputQueue& queue = queue_of(window);
  queue.anything = true;
  queue.at = {x, y};
  queue.pointer.push_back({PointerEvent::Type::move, 0, queue.mods, queue.at, {0, 0}, glfwGetTime()});
}

void on_wheel(GLFWwindow* window, double x, double y) {
  InputQueue& queue = queue_of(window);
  queue.anything = true;
  queue.pointer.push_back({PointerEvent::Type::wheel, 0, queue.mods, queue.at, {x, y}, glfwGetTime()});
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
  glfwSetMouseButtonCallback(window_, on_button);
  glfwSetCursorPosCallback(window_, on_move);
  glfwSetScrollCallback(window_, on_wheel);
  glfwSetDropCallback(window_, on_drop);
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

Gui::Gui(GLFWwindow* window) : window_(window) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  gui::prepare_io(ImGui::GetIO());
  // The backend calls the callbacks that stood before its own, so the input queue keeps seeing everything.
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  glfwSetKeyCallback(window, on_key_for_gui);
#if IMGUI_VERSION_NUM < 18700
  glfwSetCharCallback(window, on_character);  // in place of the backend's: the order of keys and characters matters
#endif
  ImGui_ImplOpenGL3_Init("#version 330 core");
}

Gui::~Gui() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

#if IMGUI_VERSION_NUM < 18700
/// Before 1.87 Dear ImGui looks at the keyboard once a frame: text fields miss presses that are shorter, and see a
/// frame's characters before its keys. So every press is shown for a frame; the same key again, keys with other
/// modifiers, and characters typed after a key that edits, in a later one.
void Gui::show_typing(InputQueue& input) {
  ImGuiIO& io = ImGui::GetIO();
  std::size_t next = 0;
  for (std::size_t n = 0; n <= input.keys.size(); ++n) {
    for (; next < input.text.size() && input.text[next].keys_before <= n; ++next)
      waiting_.push_back({{GLFW_KEY_UNKNOWN, 0, false}, input.text[next].character});
    if (n == input.keys.size()) break;
    const KeyEvent& event = input.keys[n];
    const bool modifier = event.key >= GLFW_KEY_LEFT_SHIFT && event.key <= GLFW_KEY_RIGHT_SUPER;  // in the mods
    if (event.key >= 0 && !event.repeat && !modifier && !only_types(event.key, event.mods))
      waiting_.push_back({event, 0});
  }
  const std::vector<int> before = std::move(shown_);
  shown_.clear();
  for (const int key : before) io.KeysDown[key] = glfwGetKey(window_, key) == GLFW_PRESS;
  const auto down = [&](int left, int right) { return io.KeysDown[left] || io.KeysDown[right]; };
  const auto has = [](const std::vector<int>& keys, int key) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
  };
  std::optional<int> mods;
  bool edits = false;
  std::size_t done = 0;
  for (; done < waiting_.size(); ++done) {
    const auto& [event, character] = waiting_[done];
    if (event.key == GLFW_KEY_UNKNOWN) {
      if (edits) break;
      io.AddInputCharacter(character);
      continue;
    }
    const bool again = has(before, event.key) || has(shown_, event.key);
    if (has(before, event.key)) io.KeysDown[event.key] = false;
    if (again || (mods && event.mods != mods)) break;
    io.KeysDown[event.key] = true;
    mods = event.mods;
    edits = true;
    shown_.push_back(event.key);
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + std::ptrdiff_t(done));
  // The backend has noted them as down already: seen now, they would act before their turn, and not in it.
  for (const auto& [event, character] : waiting_)
    if (event.key != GLFW_KEY_UNKNOWN) io.KeysDown[event.key] = false;
  input.unread = input.unshown = !waiting_.empty();
  io.KeyCtrl = down(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL) || (mods.value_or(0) & GLFW_MOD_CONTROL) != 0;
  io.KeyShift = down(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT) || (mods.value_or(0) & GLFW_MOD_SHIFT) != 0;
  io.KeyAlt = down(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT) || (mods.value_or(0) & GLFW_MOD_ALT) != 0;
}

/// It looks at the buttons once a frame too, and at the pointer's last place: a click and the way on within one frame
/// would choose nothing. So every frame is shown one press or release at most, with the pointer where it was then.
void Gui::show_pointer(InputQueue& input) {
  ImGuiIO& io = ImGui::GetIO();
  const auto is_button = [](const PointerEvent& event) { return event.type != PointerEvent::Type::move; };
  for (const PointerEvent& event : input.pointer)
    if (event.type != PointerEvent::Type::wheel && event.button < int(down_.size())) pointer_.push_back(event);
  const auto next = std::find_if(pointer_.begin(), pointer_.end(), is_button);
  if (next == pointer_.end()) {  // what the backend has seen is all there is
    pointer_.clear();
    std::copy(std::begin(io.MouseDown), std::end(io.MouseDown), down_.begin());
    return;
  }
  const bool dragging = std::find(down_.begin(), down_.end(), true) != down_.end();
  if (dragging && next != pointer_.begin()) {  // where a drag leads counts before the release that ends it
    std::copy(down_.begin(), down_.end(), io.MouseDown);
    io.MousePos = {(next - 1)->at.x, (next - 1)->at.y};
    pointer_.erase(pointer_.begin(), next);
    input.unshown = true;
    return;
  }
  down_[std::size_t(next->button)] = next->type == PointerEvent::Type::press;
  std::copy(down_.begin(), down_.end(), io.MouseDown);
  io.MousePos = {next->at.x, next->at.y};
  io.KeyCtrl |= (next->mods & GLFW_MOD_CONTROL) != 0;
  io.KeyShift |= (next->mods & GLFW_MOD_SHIFT) != 0;
  io.KeyAlt |= (next->mods & GLFW_MOD_ALT) != 0;
  pointer_.erase(pointer_.begin(), next + 1);
  input.unshown |= !pointer_.empty();
}
#endif

#if IMGUI_VERSION_NUM >= 18700
namespace {

bool is_key(const ImGuiInputEvent& event) {
  return event.Type == ImGuiInputEventType_Key;
}

bool is_modifier(const ImGuiInputEvent& event) {
  const ImGuiKey key = event.Key.Key;
  return is_key(event) && ((key & ImGuiMod_Mask_) != 0 || (key >= ImGuiKey_LeftCtrl && key <= ImGuiKey_RightSuper) ||
                           (key >= ImGuiKey_ReservedForModCtrl && key <= ImGuiKey_ReservedForModSuper));
}

/// A press of another key than a modifier.
bool is_press(const ImGuiInputEvent& event) {
  return is_key(event) && event.Key.Down && !is_modifier(event);
}

/// Cuts off what is for a later frame, and returns it: from the first change of a modifier behind a press on, and from
/// the first release of a button behind a move.
std::vector<ImGuiInputEvent> cut_for_later(ImVector<ImGuiInputEvent>& events) {
  bool pressed = false, moved = false;
  const ImGuiInputEvent* cut = events.begin();
  for (; cut != events.end(); ++cut) {
    const bool releases = cut->Type == ImGuiInputEventType_MouseButton && !cut->MouseButton.Down;
    if ((pressed && is_modifier(*cut)) || (moved && releases)) break;
    pressed |= is_press(*cut);
    moved |= cut->Type == ImGuiInputEventType_MousePos;
  }
  std::vector<ImGuiInputEvent> later(cut, std::as_const(events).end());
  events.resize(events.Size - int(later.size()));
  return later;
}

}  // namespace
#endif

void Gui::begin_frame(InputQueue& input) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
#if IMGUI_VERSION_NUM < 18700
  show_typing(input);
  show_pointer(input);
  ImGui::NewFrame();
#else
  // It spreads what one frame cannot hold over the next ones itself, but lets go of Ctrl in the frame that shows A, and
  // of a drag in the frame that shows where it leads.
  ImVector<ImGuiInputEvent>& queue = ImGui::GetCurrentContext()->InputEventsQueue;
  const std::vector<ImGuiInputEvent> later = cut_for_later(queue);
  ImGui::NewFrame();
  for (const ImGuiInputEvent& event : later) queue.push_back(event);
  input.unshown = !queue.empty();
  input.unread = std::any_of(queue.begin(), queue.end(), [](const ImGuiInputEvent& event) {
    return is_press(event) || event.Type == ImGuiInputEventType_Text;
  });
#endif
}

void Gui::draw() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Gui::fonts_changed() {
  ImGui_ImplOpenGL3_DestroyFontsTexture();
  ImGui_ImplOpenGL3_CreateFontsTexture();
}

}  // namespace tyglab
