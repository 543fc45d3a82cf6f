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

/// What a motion has done by some time: turned the pins about its center, and led them away.
struct Pose {
  glm::dquat turn{1, 0, 0, 0};
  glm::dvec3 center{0}, way{0};
  glm::dvec3 place(const glm::dvec3& home) const { return center + turn * (home - center) + way; }
  glm::dvec3 home(const glm::dvec3& place) const { return center + glm::conjugate(turn) * (place - way - center); }
};

Pose pose_at(const Pins::Motion& motion, double t) {
  Pose pose;
  pose.center = motion.center;
  if (!motion.path.empty()) pose.way = on_path(motion.path, t) - on_path(motion.path, 0);
  if (!spins(motion)) return pose;
  const double rate = glm::length(motion.spin), over = motion.until > 0 ? std::min(t, motion.until) : t;
  pose.turn = glm::angleAxis(rate * over, motion.spin / rate);
  return pose;
}

std::vector<Pose> poses_at(const std::vector<Pins::Motion>& motions, double t) {
  std::vector<Pose> poses;
  poses.reserve(motions.size());
  for (const Pins::Motion& motion : motions) poses.push_back(pose_at(motion, t));
  return poses;
}

}  // namespace

PinSpan pin_span(const std::vector<Pins::Motion>& motions, std::int64_t step, double since, double dt) {
  assert(dt > 0);
  using Limits = std::numeric_limits<std::int64_t>;
  std::int64_t last = Limits::min(), next = Limits::max();  // the jumps of velocities on either side
  const auto meet = [&](std::int64_t edge) {
    if (edge > step)
      next = std::min(next, edge);
    else
      last = std::max(last, edge);
  };
  // A step within which one lies is a span of its own. Returns where it ends.
  const auto jump = [&](double t) {
    constexpr double whole = 1e-6, most = 1e15;
    const double number = std::clamp((t - since) / dt, -most, most), nearest = std::round(number);
    const bool at_step = std::abs(number - nearest) <= whole;
    if (!at_step) meet(std::int64_t(std::floor(number)));
    const auto end = std::int64_t(at_step ? nearest : std::ceil(number));
    meet(end);
    return end;
  };
  bool spinning = false;
  for (const Pins::Motion& motion : motions) {
    for (const PathKey& key : motion.path) jump(key.t);
    if (spins(motion) && (motion.until == 0 || jump(motion.until) > step)) spinning = true;
  }
  if (spinning) return {step, step + 1, last == step};
  if (next == Limits::max()) return {last, next, true};  // they rest from now on
  const std::int64_t block = step - step % longest_span;
  return {std::max(block, last), std::min(block + longest_span, next), last >= block};
}

MovingPins::MovingPins(const Preset& preset, const Tears& tears, std::span<const int> pinned,
                       const std::function<glm::dvec3(int)>& x_of, double t) {
  const std::vector<Pins::Motion>& motions = preset.pins.motions;
  const Lattice lattice = lattice_of(preset);
  const std::vector<Pose> poses = poses_at(motions, t);
  std::vector<std::vector<std::uint8_t>> masks;
  masks.reserve(motions.size());
  for (const Pins::Motion& motion : motions) masks.push_back(particles_at(lattice, motion.mode, motion.list));
  for (const int particle : pinned)
    for (std::size_t n = 0; n < motions.size(); ++n)
      if (masks[n][std::size_t(tears.mesh() != nullptr ? tears.mesh()->site(particle) : particle)] != 0) {
        pins_.push_back({particle, n, poses[n].home(x_of(particle))});
        break;
      }
}

void MovingPins::copy(int particle, int copy) {
  const auto pin = std::find_if(pins_.begin(), pins_.end(), [&](const Pin& one) { return one.particle == particle; });
  if (pin != pins_.end()) pins_.push_back({copy, pin->motion, glm::dvec3(pin->home)});
}

std::vector<DrivenPin> MovingPins::in(const PinSpan& span, const std::vector<Pins::Motion>& motions, double since,
                                      double dt) const {
  assert(span.begin < span.end && dt > 0);
  // Of pins that rest for good any time will do.
  const std::int64_t begin = std::max(span.begin, span.end - longest_span);
  const double seconds = double(std::min(span.end - begin, longest_span)) * dt;
  const std::vector<Pose> before = poses_at(motions, since + double(begin) * dt),
                          after = poses_at(motions, since + double(begin) * dt + seconds);
  std::vector<DrivenPin> all;
  all.reserve(pins_.size());
  for (const auto& [particle, n, home] : pins_) {
    assert(n < motions.size());
    const glm::dvec3 x = before[n].place(home);
    all.push_back({particle, x, (after[n].place(home) - x) / seconds});
  }
  return all;
}

}  // namespace tyglab
