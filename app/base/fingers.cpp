#include "app/base/fingers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "app/base/glfw_keys.h"

namespace tyglab {
namespace {

// s after which a finger that is alone presses: at rest, once it has moved, and at rest on what it may be about to
// scroll.
constexpr double rests = 0.15, drags = 0.08, rests_on_list = 0.4;
constexpr float wheel_steps = 6;  // for twice the distance of two fingers

}  // namespace

glm::vec2 Fingers::middle() const {
  return (fingers_[0].at + fingers_[1].at) / 2.0f;
}

float Fingers::distance() const {
  return std::max(glm::distance(fingers_[0].at, fingers_[1].at), 1.0f);
}

void Fingers::hold(InputQueue& queue, int button, double time) {
  button_ = button;
  queue.on_button(button, GLFW_PRESS, 0, time);
}

void Fingers::let_go(InputQueue& queue, double time) {
  if (button_ >= 0) queue.on_button(button_, GLFW_RELEASE, 0, time);
  button_ = -1;
}

void Fingers::put_down(InputQueue& queue, glm::vec2 at, double time) {
  role_ = Role::pending;
  start_ = at, since_ = time, moved_ = false;
  wanted_ = queue.finger_button ? queue.finger_button(at) : GLFW_MOUSE_BUTTON_LEFT;
  over_cloth_ = wanted_ != GLFW_MOUSE_BUTTON_LEFT || (queue.finger_on_cloth && queue.finger_on_cloth(at));
  over_list_ = !over_cloth_ && queue.finger_on_list && queue.finger_on_list(at);
}

void Fingers::press(InputQueue& queue, double time) {
  role_ = Role::pressed;
  queue.on_move(start_, time);
  hold(queue, wanted_, time);
  if (moved_) queue.on_move(fingers_[0].at, time);
}

void Fingers::scroll(InputQueue& queue, float by, double time) const {
  queue.on_wheel({0, by / wheel_step}, time);
}

void Fingers::update(InputQueue& queue, double time) {
  if (role_ != Role::pending) return;
  if (time - since_ >= (moved_ ? drags : over_list_ ? rests_on_list : rests)) press(queue, time);
}

void Fingers::move_one(InputQueue& queue, glm::vec2 at, double time) {
  if (role_ == Role::pending) {
    const glm::vec2 by = at - start_;
    moved_ |= glm::length(by) > slack;
    if (moved_ && over_list_ && std::abs(by.y) > std::abs(by.x)) {
      role_ = Role::scrolls;
      queue.on_move(start_, time);  // the wheel turns what is under the pointer
      last_ = start_;
    }
    update(queue, time);
  } else if (role_ == Role::pressed) {
    queue.on_move(at, time);
  }
  if (role_ == Role::scrolls) scroll(queue, at.y - std::exchange(last_, at).y, time);
}

void Fingers::move_two(InputQueue& queue, double time) {
  const float apart = distance();
  const glm::vec2 now = middle();
  queue.on_move(now, time);
  if (over_cloth_)
    queue.on_wheel({0, wheel_steps * std::log2(apart / apart_)}, time);
  else
    scroll(queue, now.y - last_.y, time);
  apart_ = apart, last_ = now;
}

void Fingers::on_finger(InputQueue& queue, int id, Phase phase, glm::vec2 at, double time) {
  queue.inside = true;
  const auto finger = std::find_if(fingers_.begin(), fingers_.end(), [&](const Finger& one) { return one.id == id; });
  if (phase == Phase::down) {
    if (finger != fingers_.end() || fingers_.size() == 2) return;
    fingers_.push_back({id, at});
    if (fingers_.size() == 1) return put_down(queue, at, time);
    role_ = Role::none;
    if (button_ >= 0) queue.on_cancel(button_, time), button_ = -1;
    queue.on_move(middle(), time);
    if (over_cloth_) hold(queue, GLFW_MOUSE_BUTTON_MIDDLE, time);
    apart_ = distance(), last_ = middle();
    return;
  }
  if (finger == fingers_.end()) return;
  finger->at = at;
  if (phase == Phase::move) return fingers_.size() == 2 ? move_two(queue, time) : move_one(queue, at, time);
  if (role_ == Role::pending && phase == Phase::up) press(queue, time);
  if (role_ == Role::pressed) queue.on_move(at, time);
  role_ = Role::none;  // the other one does nothing more until it is lifted too
  let_go(queue, time);
  fingers_.erase(finger);
}

}  // namespace tyglab
