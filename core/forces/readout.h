// The forces on one particle for panels and plots: loops over the table of forces (force.h), in double.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "core/cloth/state.h"
#include "core/forces/force.h"
#include "core/model/preset.h"

namespace tyglab {

/// Forces on a particle by kind, N, without the force of the hand.
struct ParticleForces : PerForce<glm::dvec3> {
  glm::dvec3 F_int() const {
    return sum([](const Force& force) { return force.group == Force::Group::internal; });
  }
  glm::dvec3 F_ext() const {
    return sum([](const Force& force) { return force.group == Force::Group::external; });
  }
};

/// Keys of the notation table's forces: "F", one a force of the table, "F_int" and "F_ext".
std::span<const std::string_view> force_keys();
/// Which of them a panel shows: those of table B.1, and others while they act.
std::vector<std::string_view> shown_force_keys(const Preset& preset);

/// A force by those keys. T: a vector on one particle, or a size.
template <class T>
struct ForcesByKey {
  std::array<T, force::all.size() + 3> values{};  ///< in the order of force_keys(), N
  const T& operator[](std::string_view key) const { return values[std::size_t(place(key))]; }
  /// Adds the force of the hand, which is external.
  void give_hand(const T& force) { values.front() += force, values.back() += force; }

 private:
  static std::ptrdiff_t place(std::string_view key) {
    const auto keys = force_keys();
    const auto at = std::find(keys.begin(), keys.end(), key);
    assert(at != keys.end());
    return at - keys.begin();
  }
};
/// Without the force of the hand.
ForcesByKey<glm::dvec3> by_key(const ParticleForces& forces);

/// What one stencil of an internal force does to a particle.
struct StencilForce {
  const Force* force;
  int other_i, other_j;  ///< the particle at the other end, of a spring
  double length, rest;   ///< of d, m
  glm::dvec3 F{0};       ///< N
};

/// What forces do to all particles that no stencil of the lattice tells: those between particles that are near in space
/// (Force::among), and those of loose stencils (parted.h).
struct ForcesAmong {
  PerForce<double> energy;                   ///< J
  PerForce<std::vector<glm::dvec3>> forces;  ///< N, at i·columns + j; empty: the scene does not have the force
  /// Adds those on a particle.
  void add_to(ParticleForces& on, std::size_t particle) const {
    for (const Force* force : force::all)
      if (!forces[*force].empty()) on[*force] += forces[*force][particle];
  }
};
ForcesAmong forces_among(const Preset& preset, const Tears& tears, const State& state);
/// `state`: dense, with velocities at the time of the positions. Without those of forces_among().
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
/// All whole stencils of internal forces at a particle of a cloth, one by one.
std::vector<StencilForce> stencils_on_particle(const Preset& preset, const Tears& tears, const Neighborhood& near,
                                               int i, int j);

}  // namespace tyglab
