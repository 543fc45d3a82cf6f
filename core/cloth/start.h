// The initial state of a preset (docs/model.md, "Space and lattice").
#pragma once

#include <cstdint>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/model/preset.h"

namespace tyglab {

/// R x C of the preset's cloth, 1 x 1 for the mass on a spring.
Lattice lattice_of(const Preset& preset);
/// Positions and velocities at the start; pinned particles have v = 0.
StateRows start_rows(const Preset& preset);
State start_state(const Preset& preset);
/// That of every free particle, m/s; the mass on a spring moves along y alone.
glm::dvec3 starting_velocity(const Preset& preset);
/// Mask over i·columns + j of the particles that the preset pins.
std::vector<std::uint8_t> pinned_particles(const Preset& preset);
/// Whether both pin the same particles of the same lattice, by a name or by a list.
bool same_pins(const Preset& a, const Preset& b);
/// Numbers of the particles that are set in such a mask, rising.
std::vector<int> particles_in(const std::vector<std::uint8_t>& mask);

}  // namespace tyglab
