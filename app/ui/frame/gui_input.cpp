#include "app/ui/frame/frame.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <utility>

#include "app/base/glfw_keys.h"
#include "app/ui/kit/imgui_compat.h"

namespace tyglab {
namespace {

/// The keys that text fields know.
struct KnownKey {
  int number;  ///< GLFW_KEY_…
  ImGuiKey key;
};
constexpr KnownKey known_keys[]{
    {GLFW_KEY_TAB, ImGuiKey_Tab},
    {GLFW_KEY_LEFT, ImGuiKey_LeftArrow},
    {GLFW_KEY_RIGHT, ImGuiKey_RightArrow},
    {GLFW_KEY_UP, ImGuiKey_UpArrow},
    {GLFW_KEY_DOWN, ImGuiKey_DownArrow},
    {GLFW_KEY_PAGE_UP, ImGuiKey_PageUp},
    {GLFW_KEY_PAGE_DOWN, ImGuiKey_PageDown},
    {GLFW_KEY_HOME, ImGuiKey_Home},
    {GLFW_KEY_END, ImGuiKey_End},
    {GLFW_KEY_INSERT, ImGuiKey_Insert},
    {GLFW_KEY_DELETE, ImGuiKey_Delete},
    {GLFW_KEY_BACKSPACE, ImGuiKey_Backspace},
    {GLFW_KEY_ENTER, ImGuiKey_Enter},
    {GLFW_KEY_KP_ENTER, gui::keypad_enter},
    {GLFW_KEY_ESCAPE, ImGuiKey_Escape},
    {GLFW_KEY_A, ImGuiKey_A},
    {GLFW_KEY_C, ImGuiKey_C},
    {GLFW_KEY_V, ImGuiKey_V},
    {GLFW_KEY_X, ImGuiKey_X},
    {GLFW_KEY_Y, ImGuiKey_Y},
    {GLFW_KEY_Z, ImGuiKey_Z},
};

void show_key(std::size_t key, bool down) {
  for (const auto& [number, known] : known_keys)
    if (std::size_t(number) == key) gui::show_key(known, down);
}

/// Whether a press does nothing but type a character. Dear ImGui needs such keys only as text.
bool only_types(const KeyEvent& event) {
  return event.key < GLFW_KEY_ESCAPE && (event.mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) == 0;
}

constexpr int most_held = 5;  // frames; a field that opens takes three

/// Modifiers stand in what is pressed with them.
bool is_modifier(int key) {
  return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER;
}

bool is_pointers(const InputEvent& event) {
  return std::holds_alternative<PointerEvent>(event);
}

/// Whether Dear ImGui is to be shown it at all. It repeats keys itself.
bool concerns_gui(const InputEvent& event) {
  if (const auto* press = std::get_if<KeyEvent>(&event))
    return press->key >= 0 && press->key < InputQueue::most_keys && !press->repeat && !is_modifier(press->key) &&
           !only_types(*press);
  if (const auto* pointer = std::get_if<PointerEvent>(&event)) return pointer->button < InputQueue::most_buttons;
  return true;
}

}  // namespace

void GuiInput::take(const InputQueue& input) {
  std::copy_if(input.all.begin(), input.all.end(), std::back_inserter(waiting_), concerns_gui);
}

/// Those that were shown and are up by now.
void GuiInput::release_keys(const InputQueue& input) {
  changed_ = keys_ & ~input.keys_down;
  for (std::size_t key = 0; key < changed_.size(); ++key)
    if (changed_[key]) show_key(key, false);
  keys_ &= input.keys_down;
}

/// Shows an event where the frame can hold it beside what it has been shown; otherwise it waits for the next.
bool GuiInput::show(const InputEvent& event, Frame& frame) {
  return std::visit([&](const auto& it) { return show(it, frame); }, event);
}

/// Text fields see a frame's characters before its keys, and all of them with the same modifiers; a press of a button
/// is what gives them the keyboard.
bool GuiInput::show(const KeyEvent& event, Frame& frame) {
  if (frame.button || frame.mods.value_or(event.mods) != event.mods) return false;
  const auto key = std::size_t(event.key);
  if (changed_[key]) return false;
  changed_[key] = true;
  if (keys_[key]) {  // the same key again: it goes up first
    keys_[key] = false;
    show_key(key, false);
    return false;
  }
  keys_[key] = true;
  show_key(key, true);
  frame.key = true;
  frame.mods = event.mods;
  if (opens_field(event)) held_ = most_held;
  return true;
}

/// With Ctrl shown as down, text fields would ignore it.
bool GuiInput::show(const TypedCharacter& typed, Frame& frame) {
  if (frame.key || frame.button) return false;
  ImGui::GetIO().AddInputCharacter(typed.code);
  frame.text = true;
  frame.mods = 0;
  return true;
}

/// One press or release, with the pointer where it was then. Where a drag leads counts before what ends it.
bool GuiInput::show(const PointerEvent& event, Frame& frame) {
  if (event.type == PointerEvent::Type::wheel) {
    gui::show_wheel(event.wheel.x, event.wheel.y);
    return true;
  }
  if (frame.button) return false;
  if (event.type == PointerEvent::Type::move) {
    frame.moved = true;
  } else {
    if (frame.key || frame.text || (frame.moved && buttons_.any())) return false;
    buttons_[std::size_t(event.button)] = event.type == PointerEvent::Type::press;
    if (!event.click) gui::forget_press();
    frame.button = true;
    frame.mods = event.mods;
  }
  at_ = event.at;
  return true;
}

void GuiInput::tell_what_waits(InputQueue& input) const {
  input.unshown = !waiting_.empty();
  input.unread = !std::all_of(waiting_.begin(), waiting_.end(), is_pointers);
}

void GuiInput::hold(InputQueue& input) {
  take(input);
  tell_what_waits(input);
}

void GuiInput::feed(InputQueue& input) {
  take(input);
  if (std::exchange(focused_, input.focused) != input.focused) ImGui::GetIO().AddFocusEvent(input.focused);
  release_keys(input);
  Frame frame;
  held_ = gui::typing_text() ? 0 : std::max(held_ - 1, 0);
  if (std::exchange(input.field_opens, false)) held_ = most_held;
  const auto next = std::find_if_not(waiting_.begin(), waiting_.end(),
                                     [&](const InputEvent& event) { return held_ == 0 && show(event, frame); });
  waiting_.erase(waiting_.begin(), next);
  if (waiting_.empty()) buttons_ = input.buttons, at_ = input.at;  // so that nothing lost stays
  tell_what_waits(input);
  const bool seen = input.inside || input.focused || buttons_.any();
  gui::show_pointer(seen ? ImVec2(at_.x, at_.y) : ImVec2(-FLT_MAX, -FLT_MAX));
  for (int button = 0; button < InputQueue::most_buttons; ++button)
    gui::show_button(button, buttons_[std::size_t(button)]);
  const int mods = frame.mods.value_or(input.mods);
  gui::show_mods((mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_ALT) != 0);
}

}  // namespace tyglab
