#include "core/moving_pins.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "core/cloth/state.h"

namespace tyglab {
namespace {

/// Spans of a path end there at the latest: what sums of small displacements round away stays small.
constexpr std::int64_t longest_span = 64;

bool spins(const Pins::Motion& motion) {
  return motion.spin != glm::dvec3(0);
}

/// How far the path has led by then.
glm::dvec3 way(const Pins::Motion& motion, double t) {
  return motion.path.empty() ? glm::dvec3(0) : on_path(motion.path, t) - on_path(motion.path, 0);
}

/// `v` turned as far as the motion has by then; `sign` -1: back.
glm::dvec3 turned(const Pins::Motion& motion, double t, double sign, const glm::dvec3& v) {
  if (!spins(motion)) return v;
  const double rate = glm::length(motion.spin), over = motion.until > 0 ? std::min(t, motion.until) : t;
  return glm::angleAxis(sign * rate * over, motion.spin / rate) * v;
}

glm::dvec3 place(const Pins::Motion& motion, const glm::dvec3& home, double t) {
  return motion.center + turned(motion, t, 1, home - motion.center) + way(motion, t);
}

}  // namespace

MovingPins::MovingPins(const Preset& preset, std::span<const int> pinned, const std::function<glm::dvec3(int)>& x_of,
                       double t)
    : motions_(preset.pins.motions) {
  const Lattice lattice = lattice_of(preset);
  std::vector<std::vector<std::uint8_t>> masks;
  for (const Pins::Motion& motion : motions_) masks.push_back(particles_at(lattice, motion.mode, motion.list));
  for (const int particle : pinned)
    for (std::size_t n = 0; n < motions_.size(); ++n) {
      if (masks[n][std::size_t(particle)] == 0) continue;
      const Pins::Motion& motion = motions_[n];
      const glm::dvec3 home = motion.center + turned(motion, t, -1, x_of(particle) - way(motion, t) - motion.center);
      pins_.push_back({particle, n, home});
      break;
    }
}

PinSpan MovingPins::span_at(std::int64_t step, double since, double dt) const {
  assert(dt > 0);
  PinSpan span{step - step % longest_span, step - step % longest_span + longest_span};
  bool spinning = false, moves_later = false;
  // A time at which velocities jump; a step that it divides is a span of its own.
  const auto jump = [&](double t) {
    constexpr double whole = 1e-6;
    const double number = (t - since) / dt, nearest = std::round(number);
    moves_later = moves_later || number > double(step);
    if (!(std::abs(number) < 1e15)) return;
    const bool divides = std::abs(number - nearest) > whole;
    for (const double edge : {divides ? std::floor(number) : nearest, divides ? std::ceil(number) : nearest}) {
      const auto at = std::int64_t(edge);
      if (at > step) span.end = std::min(span.end, at);
      if (at <= step && at >= span.begin) span.begin = at, span.after_jump = true;
    }
  };
  for (const Pins::Motion& motion : motions_) {
    for (const PathKey& key : motion.path) jump(key.t);
    if (!spins(motion)) continue;
    if (motion.until > 0) jump(motion.until);
    if (motion.until == 0 || since + double(step) * dt < motion.until) spinning = true;
  }
  if (spinning) return {step, step + 1, span.after_jump && span.begin == step};
  // From the last key on they rest.
  if (!moves_later && span.after_jump) span.end = std::numeric_limits<std::int64_t>::max();
  return span;
}

std::vector<DrivenPin> MovingPins::at(double t, double seconds) const {
  assert(seconds > 0);
  std::vector<DrivenPin> all;
  all.reserve(pins_.size());
  for (const auto& [particle, n, home] : pins_) {
    const glm::dvec3 x = place(motions_[n], home, t);
    all.push_back({particle, x, (place(motions_[n], home, t + seconds) - x) / seconds});
  }
  return all;
}

}  // namespace tyglab
