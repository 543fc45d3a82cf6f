// The forces on one particle, gathered in double from a state: what panels and plots show. The sweeps of the engines
// compute the same formulas (spring.h, wind.h), spring by spring.
#pragma once

#include <glm/vec3.hpp>

#include "core/cloth/state.h"
#include "core/cloth/tears.h"
#include "core/notation/preset.h"

namespace tyglab {

/// Forces by kind, N.
struct ParticleForces {
  glm::dvec3 F_s{0}, F_b{0}, F_d{0}, F_g{0}, F_wind{0};
  glm::dvec3 F_int() const { return F_s + F_b + F_d; }
  /// Without the hand.
  glm::dvec3 F_ext() const { return F_g + F_wind; }
};

/// `state`: dense, velocities that belong to the positions.
ParticleForces forces_on_particle(const Preset& preset, const Tears& tears, const State& state, int i, int j);

}  // namespace tyglab
