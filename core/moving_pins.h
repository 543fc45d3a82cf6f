// Pinned particles that move as the preset says (Pins::Motion).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

/// Steps over which all pins keep their velocities: those with numbers begin to end - 1.
struct PinSpan {
  std::int64_t begin = 0, end = 0;
  bool after_jump = false;  ///< velocities may jump where it begins
};
/// The one around a step, where steps of dt are counted from time `since`, s. It depends on nothing else, so however
/// many steps are made at once, the motion is the same to the last bit.
PinSpan pin_span(const std::vector<Pins::Motion>& motions, std::int64_t step, double since, double dt);

/// The pinned particles that move, each by one of the preset's motions.
class MovingPins {
 public:
  MovingPins() = default;
  /// x_of says where each pinned particle is at time t, s. Copies of a cloth that has parted move with their sites.
  MovingPins(const Preset& preset, const Tears& tears, std::span<const int> pinned,
             const std::function<glm::dvec3(int)>& x_of, double t);
  bool empty() const { return pins_.empty(); }
  /// Another particle moves as one that moves.
  void copy(int particle, int copy);
  std::size_t bytes() const { return pins_.capacity() * sizeof(Pin); }
  /// Where they are when that span of steps begins, and their velocities in it. `motions`: those that they were made
  /// with.
  std::vector<DrivenPin> in(const PinSpan& span, const std::vector<Pins::Motion>& motions, double since,
                            double dt) const;

 private:
  struct Pin {
    int particle;
    std::size_t motion;
    glm::dvec3 home;  ///< where it is at t = 0, m
  };
  std::vector<Pin> pins_;
};

}  // namespace tyglab
