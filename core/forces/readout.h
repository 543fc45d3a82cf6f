// The forces on one particle for panels and plots, computed in double from a state. The engines compute these formulas
// (spring-inl.h, wind-inl.h) spring by spring.
#pragma once

#include <array>
#include <cassert>
#include <cstdlib>
#include <glm/vec3.hpp>
#include <vector>

#include "core/cloth/state.h"
#include "core/model/preset.h"

namespace tyglab {

/// Forces on a particle by kind, N.
struct ParticleForces {
  glm::dvec3 F_s{0}, F_b{0}, F_d{0}, F_g{0}, F_wind{0};
  glm::dvec3 F_int() const { return F_s + F_b + F_d; }
  /// Without the force of the hand.
  glm::dvec3 F_ext() const { return F_g + F_wind; }
};

/// The force of one spring on a particle.
struct SpringForce {
  int i, j;  ///< the particle at the other end
  bool bending;
  double length, rest;      ///< m
  glm::dvec3 F{0}, F_d{0};  ///< N: F_s or F_b, and the damping of a stretch spring
};

/// `state`: dense, with velocities at the time of the positions.
ParticleForces forces_on_particle(const Preset& preset, const Tears& tears, const State& state, int i, int j);

/// The surroundings of one particle, three rows and columns in each direction: enough for the forces on it and on its
/// neighbors.
class Neighborhood {
 public:
  static constexpr int reach = 3;
  Neighborhood(int i, int j) : i_(i), j_(j) {}
  glm::dvec3& x(int i, int j) { return x_[index(i, j)]; }
  glm::dvec3& v(int i, int j) { return v_[index(i, j)]; }
  const glm::dvec3& x(int i, int j) const { return x_[index(i, j)]; }
  const glm::dvec3& v(int i, int j) const { return v_[index(i, j)]; }

 private:
  static constexpr int side = 2 * reach + 1;
  std::size_t index(int i, int j) const {
    assert(std::abs(i - i_) <= reach && std::abs(j - j_) <= reach);
    return std::size_t((i - i_ + reach) * side + j - j_ + reach);
  }
  int i_, j_;
  std::array<glm::dvec3, std::size_t(side) * side> x_{}, v_{};
};
/// The same from its surroundings: (i, j) is the particle in the middle or a neighbor of it.
ParticleForces forces_on_particle(const Preset& preset, const Tears& tears, const Neighborhood& near, int i, int j);
/// All whole springs at a particle of a cloth, one by one.
std::vector<SpringForce> springs_on_particle(const Preset& preset, const Tears& tears, const Neighborhood& near, int i,
                                             int j);

}  // namespace tyglab
