// Pinned particles that move as the preset says (Pins::Motion).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

/// The steps over which all of them keep their velocities: those with numbers begin to end - 1.
struct PinSpan {
  std::int64_t begin = 0, end = 0;
  bool after_jump = false;  ///< before it they had others, which are not near these
};

class MovingPins {
 public:
  MovingPins() = default;
  /// Of the pinned particles those that move; x_of says where each one is at time t, s.
  MovingPins(const Preset& preset, std::span<const int> pinned, const std::function<glm::dvec3(int)>& x_of, double t);
  bool empty() const { return pins_.empty(); }
  /// The steps around that one, where steps of dt are counted from time `since`, s. It depends on nothing but time, so
  /// however many steps are made at once, the motion is the same to the last bit.
  PinSpan span_at(std::int64_t step, double since, double dt) const;
  /// Where they are at time t, and their mean velocities over the `seconds` that follow.
  std::vector<DrivenPin> at(double t, double seconds) const;

 private:
  struct Pin {
    int particle;
    std::size_t motion;
    glm::dvec3 home;  ///< where it is at t = 0, m
  };
  std::vector<Pins::Motion> motions_;
  std::vector<Pin> pins_;
};

}  // namespace tyglab
