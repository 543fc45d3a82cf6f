// The canvas of a page as the window. Events of the browser come from app/platform/web/library.js, at any time between
// frames; keys and buttons have GLFW's numbers.
#include "app/platform/platform.h"

#include <emscripten.h>
#include <emscripten/html5.h>
#include <glad/gl.h>
#include <imgui.h>

#include <algorithm>
#include <utility>

#include "app/base/fingers.h"
#include "app/base/glfw_keys.h"
#include "app/platform/gl/dialect.h"
#include "app/render/gl_objects.h"

// Of app/platform/web/library.js.
extern "C" {
int tyglab_has_canvas();
void tyglab_listen();
void tyglab_set_title(const char* title);
void tyglab_tell(const char* part, const char* words);
int tyglab_prefers(const char* query);
void tyglab_full_screen();
int tyglab_is_full_screen();
int tyglab_is_hidden();
void tyglab_set_cursor(const char* name);
void tyglab_copy(const char* text);
void tyglab_first_frame();
void tyglab_type_by_touch(int wanted);
}

namespace tyglab {
namespace {

/// What the browser has told: there is one canvas.
struct Canvas {
  InputQueue* queue = nullptr;
  int width = 1, height = 1;  ///< of its buffer, pixels
  float scale = 1;            ///< pixels for one of a page's
  float around = 0;           ///< pixels around a control where a finger still means it; 0: a mouse points
  std::string clipboard;
  Fingers fingers;
};

Canvas& canvas() {
  static Canvas only;
  return only;
}

const char* cursor_name(ImGuiMouseCursor cursor) {
  switch (cursor) {
    case ImGuiMouseCursor_TextInput:
      return "text";
    case ImGuiMouseCursor_ResizeAll:
      return "move";
    case ImGuiMouseCursor_ResizeNS:
      return "ns-resize";
    case ImGuiMouseCursor_ResizeEW:
      return "ew-resize";
    case ImGuiMouseCursor_Hand:
      return "pointer";
    case ImGuiMouseCursor_NotAllowed:
      return "not-allowed";
    default:
      return "default";
  }
}

/// What was held when the page lost the keyboard is not held any more.
void release_everything(InputQueue& queue) {
  for (int key = 0; key < InputQueue::most_keys; ++key)
    if (queue.keys_down[std::size_t(key)]) queue.on_key(key, GLFW_RELEASE, 0);
  for (int button = 0; button < InputQueue::most_buttons; ++button)
    if (queue.buttons[std::size_t(button)]) queue.on_button(button, GLFW_RELEASE, 0, window_time());
  queue.mods = 0;
}

}  // namespace
}  // namespace tyglab

// Called by app/platform/web/library.js.
extern "C" {
using tyglab::canvas;

EMSCRIPTEN_KEEPALIVE void tyglab_on_size(int width, int height, float scale, float around) {
  auto& it = canvas();
  it.around = around;
  const bool rescaled = std::exchange(it.scale, scale) != scale;
  it.width = width, it.height = height;
  if (it.queue == nullptr) return;
  it.queue->by_touch = around > 0;
  it.queue->double_click_px = around > 0 ? 4 * around : 6 * scale;
  it.fingers.slack = std::max(1.5f * around, 6.f);
  it.queue->anything = true;
  it.queue->scale_changed |= rescaled;
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_key(int key, int action, int mods) {
  canvas().queue->on_key(key, action, mods);
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_character(unsigned code) {
  canvas().queue->on_character(code);
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_pointer(float x, float y) {
  canvas().queue->inside = true;
  canvas().queue->on_move({x, y}, tyglab::window_time());
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_button(int button, int action, int mods) {
  canvas().queue->on_button(button, action, mods, tyglab::window_time());
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_wheel(float x, float y) {
  canvas().queue->on_wheel({x, y}, tyglab::window_time());
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_finger(int id, int phase, float x, float y) {
  canvas().fingers.on_finger(*canvas().queue, id, static_cast<tyglab::Fingers::Phase>(phase), {x, y},
                             tyglab::window_time());
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_focus(int focused) {
  tyglab::InputQueue& queue = *canvas().queue;
  queue.focused = focused != 0;
  queue.anything = true;
  if (focused == 0) tyglab::release_everything(queue);
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_inside(int inside) {
  canvas().queue->inside = inside != 0;
  canvas().queue->anything = true;
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_drop(const char* what) {
  canvas().queue->dropped.emplace_back(what);
  canvas().queue->anything = true;
}

EMSCRIPTEN_KEEPALIVE void tyglab_on_clipboard(const char* text) {
  canvas().clipboard = text;
}
}

namespace tyglab {

bool display_there() {
  return tyglab_has_canvas() != 0;
}

bool prefers_light() {
  return tyglab_prefers("(prefers-color-scheme: light)") != 0;
}

bool prefers_little_motion() {
  return tyglab_prefers("(prefers-reduced-motion: reduce)") != 0;
}

double window_time() {
  return emscripten_get_now() / 1000;
}

struct Window::Parts {
  EMSCRIPTEN_WEBGL_CONTEXT_HANDLE context = 0;
  std::string title = {};
  bool shown = false;
};

Window::Window(int, int, const Settings&, InputQueue& queue) : parts_(std::make_unique<Parts>()) {
  EmscriptenWebGLContextAttributes wish;
  emscripten_webgl_init_context_attributes(&wish);
  wish.alpha = wish.depth = wish.antialias = false;
  wish.majorVersion = 2;
  wish.powerPreference = EM_WEBGL_POWER_PREFERENCE_HIGH_PERFORMANCE;
  parts_->context = emscripten_webgl_create_context("#canvas", &wish);
  if (parts_->context <= 0)
    throw GraphicsError("This browser has no WebGL 2. Use a current Firefox, Chrome, Edge or Safari.");
  emscripten_webgl_make_context_current(parts_->context);
  canvas().queue = &queue;
  tyglab_listen();
}

Window::~Window() {
  emscripten_webgl_destroy_context(parts_->context);
}

void Window::take_events(double) {
  canvas().fingers.update(*canvas().queue, window_time());
}

/// The browser shows it once the turn is over.
void Window::swap() {
  if (!std::exchange(parts_->shown, true)) tyglab_first_frame();
}

void Window::wait_for_screen(bool) {}

bool Window::wants_close() const {
  return false;
}

void Window::forget_close() {}

bool Window::hidden() const {
  return tyglab_is_hidden() != 0;
}

void Window::set_title(const std::string& title) {
  if (title == parts_->title) return;
  parts_->title = title;
  tyglab_set_title(title.c_str());
}

void Window::tell(const std::string& part, const std::string& words) {
  tyglab_tell(part.c_str(), words.c_str());
}

void Window::toggle_full_screen() {
  tyglab_full_screen();
}

bool Window::full_screen() const {
  return tyglab_is_full_screen() != 0;
}

glm::ivec2 Window::size() const {
  return {canvas().width, canvas().height};
}

glm::ivec2 Window::framebuffer_size() const {
  return size();
}

float Window::content_scale() const {
  return std::clamp(canvas().scale, 0.5f, 4.f);
}

double Window::frame_time() const {
  return 1.0 / 60;
}

void Window::remember(Settings&) const {}

Image Window::pixels() const {
  return {size().x, size().y, read_pixels(size().x, size().y)};
}

GuiBackend::GuiBackend(Window&) {
  ImGuiIO& io = ImGui::GetIO();
  io.BackendFlags |= ImGuiBackendFlags_HasMouseCursors;
  io.SetClipboardTextFn = [](void*, const char* text) {
    canvas().clipboard = text;
    tyglab_copy(text);
  };
  io.GetClipboardTextFn = [](void*) { return canvas().clipboard.c_str(); };
}

GuiBackend::~GuiBackend() = default;

void GuiBackend::begin_frame() {
  ImGuiIO& io = ImGui::GetIO();
  static double last = window_time() - 1.0 / 60;
  const double now = window_time();
  io.DeltaTime = float(std::clamp(now - std::exchange(last, now), 1e-4, 1.0));
  io.DisplaySize = ImVec2(float(canvas().width), float(canvas().height));
  if (ImGui::GetFontSize() > 0) canvas().fingers.wheel_step = 5 * ImGui::GetFontSize();  // what Dear ImGui scrolls
  ImGui::GetStyle().TouchExtraPadding = ImVec2(canvas().around, canvas().around);
  tyglab_set_cursor(cursor_name(ImGui::GetMouseCursor()));
  tyglab_type_by_touch(io.WantTextInput ? 1 : 0);
}

}  // namespace tyglab
