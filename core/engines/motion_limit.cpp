#include "core/engines/motion_limit.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/engines/fault.h"
#include "core/forces/contact.h"
#include "core/forces/force.h"

namespace tyglab {
namespace {

/// What springs can hold that whole springs may be long, as Σ |v|², m²/s²: the rule that judges their lengths comes
/// first. A step that makes a spring that long moves its ends by as much, hence 1/dt². Springs that tear leave it
/// nothing to judge: there it is 0.
double reach_squared(const Preset& p, const Lattice& lattice) {
  if (p.kind == Kind::cloth && p.F_max > 0) return 0;
  const double per_step = 1 / (p.dt * p.dt);
  if (p.kind == Kind::one_weight) {
    const double farthest = longest_factor * std::max(p.L, std::abs(p.offset));
    return farthest * farthest * (p.k / p.m + per_step);
  }
  double sum = 0;
  for (int d = 0; d < int(directions.size()); ++d) {
    const Direction& dir = directions[d];
    const double springs = double(std::max(lattice.rows - dir.di, 0)) * std::max(lattice.columns - std::abs(dir.dj), 0);
    const double longest = longest_factor * dir.rest * p.L;
    // A spring that pushes holds most where its ends meet.
    const double k = spring_constant(p, dir),
                 held = dir.bending ? k * std::pow(dir.rest * p.L, 2) : k * longest * longest;
    sum += springs * (held / p.m + longest * longest * per_step);
  }
  for_each_stencil(p, [&](const Force& force, const Stencil& stencil) {
    if (force.linear == nullptr) return;
    double weights = 0;  // the sum of those above 0: so many springs at most of two rest lengths, end to end
    for (const Stencil::Point& point : stencil.at) weights += std::max(point.weight, 0.0);
    const double longest = weights * longest_factor * 2 * p.L;
    sum += double(lattice.size()) * force.linear(p, stencil) / p.m * longest * longest;
  });
  return sum + double(lattice.size()) * 2 / p.m * most_curl_energy(p, longest_factor);
}

}  // namespace

void MotionLimit::set_scene(const Preset& p, const Lattice& lattice, bool held, const glm::dvec3& hand) {
  assert(p.dt > 0 && p.m > 0 && lattice.size() > 0);
  constexpr double stretch_springs = 8, triangles = 8, corners = 3;
  const bool cloth = p.kind == Kind::cloth;
  // What the hand lets go keeps its velocity.
  if (!held) begun_squared_ += hand_squared_;
  const double hand_speed = held ? glm::length(hand) : 0;
  hand_squared_ = hand_speed * hand_speed;
  particles_ = lattice.size(), dt_ = p.dt;
  const double wind = cloth ? triangles / corners * glm::length(p.W) / p.m : 0;
  // Air pushes only what is slower than it, up to |u| away from it; stretched triangles have up to twice the area here.
  const double u = force::air.on(p) ? glm::length(p.u) : 0, twice = 2;
  const double pushes = std::min(triangles / corners * twice * p.air_density / 4 * p.L * p.L * (p.C_N + p.C_T) * 2 * u,
                                 triangles * 2 * most_air_damping(p, p.dt));
  const double air = pushes * 2 * u / p.m;
  const double at_hand = std::sqrt(sum_of(&Force::at_particle, p) / p.m);
  acceleration_ = std::sqrt(particles_) * (std::abs(p.g) + wind + air) + at_hand * hand_speed;
  // A body or pins that move may throw the cloth about: what energy that is no formula says.
  // Neither is the energy of layers one that it measures.
  if (any_moves(p.bodies) || !p.pins.motions.empty() || force::self.on(p))
    acceleration_ = std::numeric_limits<double>::infinity();
  damping_ = stretch_springs / 2 * p.k_d / p.m * hand_squared_;
  fastest_mode_ = std::sqrt(sum_of(&Force::largest_eigenvalue, p) / p.m);
  reach_squared_ = reach_squared(p, lattice);
  constexpr double roundings = 16;
  noise_ = std::sqrt(particles_) * roundings * (p.precision == Precision::float_ ? 0x1p-24 : 0x1p-53) / p.dt;
  update();
}

void MotionLimit::begin(const Motion& motion) {
  assert(!(motion.squared < 0) && !(motion.farthest < 0) && !(motion.pushed < 0));
  begun_squared_ = motion.squared, gained_ = 0;
  begun_farthest_ = farthest_ = motion.farthest;
  push(motion.pushed);
}

void MotionLimit::push(double distance) {
  assert(!(distance < 0));
  gained_ += fastest_mode_ * distance, farthest_ += distance;
  update();
}

void MotionLimit::update() {
  assert(!(gained_ < 0) && !(begun_squared_ < 0));
  const double most = std::sqrt(begun_squared_) + gained_;
  given_squared_ = most * most + hand_squared_ + std::pow(noise_ * begun_farthest_, 2);
  most_squared_ = factor * (given_squared_ + reach_squared_);
}

void MotionLimit::pass(double dt) {
  assert(!(dt < 0));  // time goes on, and with it the bounds
  if (dt > 0) gained_ += acceleration_ * dt;
  begun_squared_ += damping_ * dt;
  update();
  farthest_ += std::sqrt(most_squared_) * dt;
}

}  // namespace tyglab
