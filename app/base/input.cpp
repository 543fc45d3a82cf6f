
#include "app/base/input.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "app/base/glfw_keys.h"

namespace tyglab {

void InputQueue::on_key(int key, int action, int given_mods) {
  anything = true;
  if (key >= 0 && key < most_keys) keys_down[std::size_t(key)] = action != GLFW_RELEASE;
  if (action != GLFW_RELEASE) {
    const KeyEvent event{key, given_mods, action == GLFW_REPEAT};
    keys.push_back(event);
    all.emplace_back(event);
  }
  // GLFW tells the modifiers as they were before a modifier key itself changed.
  mods = given_mods;
  const auto track = [&](int left, int right, int bit) {
    if (key == left || key == right) mods = action == GLFW_RELEASE ? mods & ~bit : mods | bit;
  };
  track(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT, GLFW_MOD_SHIFT);
  track(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL, GLFW_MOD_CONTROL);
  track(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT, GLFW_MOD_ALT);
}

void InputQueue::on_character(unsigned code) {
  anything = true;
  all.emplace_back(TypedCharacter{code});
}

void InputQueue::on_button(int button, int action, int given_mods, double time) {
  mods = given_mods;
  if (button < most_buttons) buttons[std::size_t(button)] = action == GLFW_PRESS;
  if (button == GLFW_MOUSE_BUTTON_LEFT && action == GLFW_PRESS) note_left_press(time);
  const auto type = action == GLFW_PRESS ? PointerEvent::Type::press : PointerEvent::Type::release;
  add({type, button, mods, at, {0, 0}, time});
}

void InputQueue::on_cancel(int button, double time) {
  if (button < most_buttons) buttons[std::size_t(button)] = false;
  add({PointerEvent::Type::release, button, mods, at, {0, 0}, time, false});
}

void InputQueue::on_move(glm::vec2 to, double time) {
  at = to;
  add({PointerEvent::Type::move, 0, mods, at, {0, 0}, time});
}

void InputQueue::on_wheel(glm::vec2 by, double time) {
  add({PointerEvent::Type::wheel, 0, mods, at, by, time});
}

void InputQueue::add(const PointerEvent& event) {
  anything = true;
  pointer.push_back(event);
  all.emplace_back(event);
}

/// Two in quick succession are a double click even where one frame holds both.
void InputQueue::note_left_press(double time) {
  const float apart = std::hypot(at.x - last_press_at.x, at.y - last_press_at.y);
  const bool second = time - last_press < double_click_s && apart < double_click_px;
  if (second) double_click = true, double_click_frames = 3;
  last_press = second ? -1 : time;
  last_press_at = at;
}

void InputQueue::clear() {
  keys.clear(), pointer.clear(), all.clear(), dropped.clear();
  scale_changed = anything = false;
  double_click = double_click_frames > 0 && --double_click_frames > 0;
}

int Viewport::tile_at(glm::vec2 p) const {
  const glm::vec2 inside = (p - box.lo) / glm::max(size(), glm::vec2(1));
  return std::clamp(int(inside.y), 0, rows - 1) * columns + std::clamp(int(inside.x), 0, columns - 1);
}

void Viewport::divide(int pictures) {
  // The division whose pictures are nearest to square.
  const glm::vec2 whole = box.hi - box.lo;
  float best = std::numeric_limits<float>::infinity();
  for (int across = 1; across <= pictures; ++across) {
    const int down = (pictures + across - 1) / across;
    if (across * down - pictures >= across) continue;  // an empty row
    const float shape = std::abs(std::log(whole.x / float(across) / std::max(whole.y / float(down), 1.f)));
    if (shape < best) best = shape, columns = across, rows = down;
  }
}

}  // namespace tyglab
