#include "app/platform/web/fingers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "app/base/glfw_keys.h"
#include "app/platform/platform.h"

namespace tyglab {

glm::vec2 Fingers::middle() const {
  return (fingers_[0].at + fingers_[1].at) / 2.0f;
}

float Fingers::distance() const {
  return std::max(glm::distance(fingers_[0].at, fingers_[1].at), 1.0f);
}

void Fingers::hold(InputQueue& queue, int button) {
  button_ = button;
  queue.on_button(button, GLFW_PRESS, 0, window_time());
}

void Fingers::let_go(InputQueue& queue) {
  if (button_ >= 0) queue.on_button(button_, GLFW_RELEASE, 0, window_time());
  button_ = -1;
}

void Fingers::move_two(InputQueue& queue) {
  const float apart = distance();
  const glm::vec2 now = middle();
  queue.on_move(now, window_time());
  constexpr float wheel_steps = 6;     // for twice the distance
  constexpr float pixels_a_step = 40;  // of a panel that scrolls
  if (over_cloth_)
    queue.on_wheel({0, wheel_steps * std::log2(apart / apart_)}, window_time());
  else
    queue.on_wheel({0, (now.y - last_.y) / pixels_a_step}, window_time());
  apart_ = apart, last_ = now;
}

void Fingers::on_finger(InputQueue& queue, int id, Phase phase, glm::vec2 at) {
  queue.inside = true;
  const auto finger = std::find_if(fingers_.begin(), fingers_.end(), [&](const Finger& one) { return one.id == id; });
  if (phase == Phase::down) {
    if (finger != fingers_.end() || fingers_.size() == 2) return;
    fingers_.push_back({id, at});
    if (fingers_.size() == 1) {
      queue.on_move(at, window_time());
      hold(queue, queue.finger_button ? queue.finger_button(at) : GLFW_MOUSE_BUTTON_LEFT);
      over_cloth_ = button_ != GLFW_MOUSE_BUTTON_LEFT || (queue.finger_on_cloth && queue.finger_on_cloth(at));
      return;
    }
    let_go(queue);
    queue.on_move(middle(), window_time());
    if (over_cloth_) hold(queue, GLFW_MOUSE_BUTTON_MIDDLE);
    apart_ = distance(), last_ = middle();
    return;
  }
  if (finger == fingers_.end()) return;
  finger->at = at;
  if (phase == Phase::move) return fingers_.size() == 2 ? move_two(queue) : queue.on_move(at, window_time());
  if (fingers_.size() == 1) queue.on_move(at, window_time());
  let_go(queue);
  fingers_.erase(finger);  // the other one does nothing more until it is lifted too
}

}  // namespace tyglab
