#include "app/session/sleep.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/forces/contact.h"
#include "core/forces/force.h"

namespace tyglab {
namespace {

// Parts of the cloth's side. What swings with a period of 2πτ or less covers, in a window of 2τ, at least 1 − cos 1 =
// 0.46 of its amplitude, so it sleeps with a hundredth of the error allowed. What creeps, strongly damped, toward
// where it will hang keeps within that error while it needs less than a hundred windows for the way that is left.
constexpr double still_part = 1e-6, error_part = 1e-4;

bool may_sleep(const Simulation& simulation) {
  const Preset& p = simulation.preset();
  return p.kind == Kind::cloth && p.W == glm::dvec3(0) && (p.u == glm::dvec3(0) || !force::air.on(p)) &&
         !any_moves(p.bodies) && p.pins.motions.empty() && !simulation.held() && !simulation.divergence();
}

/// Where particles are that tell that a cloth moves: its lower corner and, in case that is pinned, two others.
std::array<glm::dvec3, 3> scouts(const Simulation& simulation) {
  const Lattice lattice = simulation.lattice().sites();
  return {simulation.position(lattice.rows - 1, lattice.columns - 1),
          simulation.position(lattice.rows / 2, lattice.columns / 2), simulation.position(lattice.rows - 1, 0)};
}

}  // namespace

RestTolerance rest_tolerance(const Preset& p) {
  assert(p.L > 0 && p.rows >= 1 && p.columns >= 1);
  const double side = p.L * std::max({p.rows - 1, p.columns - 1, 1});
  const double swing = p.g != 0 ? std::sqrt(side / std::abs(p.g)) : 1;
  return {still_part * side, 2 * swing, error_part * side / swing, error_part * side};
}

void Sleep::begin(const Simulation& simulation) {
  if (simulation.revision() == seen_) return;
  asleep_ = false;
  scouts_.reset();
}

void Sleep::look(Simulation& simulation, bool touched) {
  seen_ = simulation.revision();
  asleep_ = false;
  if (touched || !may_sleep(simulation)) return scouts_.reset();
  if (!scouts_ || !scouts_stay(simulation)) return set_out(simulation);
  const RestTolerance tolerance = rest_tolerance(simulation.preset());
  const double rested = simulation.time() - since_;
  assert(!(rested < 0));
  // To look at the whole cloth takes time, and of a graphics card a copy: only once a few particles are still.
  if (anchor_.empty() && rested < tolerance.window / 4) return;
  if (anchor_.empty()) return take_anchor(simulation);
  if (!near_anchor(simulation, tolerance.radius)) return set_out(simulation);
  if (rested < tolerance.window) return;
  if (largest_speed(simulation) > tolerance.speed) return set_out(simulation);
  asleep_ = true;
}

/// Begins a new watch.
void Sleep::set_out(const Simulation& simulation) {
  anchor_.clear();
  scouts_ = scouts(simulation);
  since_ = simulation.time();
}

bool Sleep::scouts_stay(const Simulation& simulation) const {
  assert(scouts_);
  const double radius = rest_tolerance(simulation.preset()).radius;
  const auto now = scouts(simulation);
  return std::equal(now.begin(), now.end(), scouts_->begin(), [radius](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::dot(a - b, a - b) <= radius * radius;
  });
}

void Sleep::take_anchor(const Simulation& simulation) {
  const PositionView x = simulation.positions();
  anchor_.clear();
  anchor_.reserve(std::size_t(x.rows) * x.columns);
  for (int i = 0; i < x.rows; ++i)
    for (int j = 0; j < x.columns; ++j) anchor_.push_back(x.at(i, j));
  since_ = simulation.time();
}

bool Sleep::near_anchor(const Simulation& simulation, double radius) const {
  assert(!anchor_.empty());
  const PositionView x = simulation.positions();
  if (anchor_.size() != std::size_t(x.rows) * x.columns) return false;
  auto place = anchor_.begin();
  for (int i = 0; i < x.rows; ++i)
    for (int j = 0; j < x.columns; ++j) {
      const glm::dvec3 away = x.at(i, j) - *place++;
      if (!(glm::dot(away, away) <= radius * radius)) return false;
    }
  return true;
}

double largest_speed(Simulation& simulation) {
  const VectorField<double>& v = simulation.read().v;
  assert(v.y.size() == v.x.size() && v.z.size() == v.x.size());
  double largest = 0;
  for (std::size_t p = 0; p < v.x.size(); ++p)
    largest = std::max(largest, v.x[p] * v.x[p] + v.y[p] * v.y[p] + v.z[p] * v.z[p]);
  return std::sqrt(largest);
}

}  // namespace tyglab
