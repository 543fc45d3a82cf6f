// Whether the cloth of a simulation passes through itself.
#pragma once

#include <string>

#include "core/contact/crossings.h"
#include "core/simulation.h"

namespace tyglab {

/// Positions of all particles, dense, m.
VectorField<double> dense_positions(const Simulation& simulation);

/// The crossing triangles of the cloth as it is now; none after a divergence.
Crossings self_crossings(const Simulation& simulation, const CrossingLimits& limits = {});

/// A sentence about them; empty if there are none.
std::string crossings_in_words(const Crossings& crossings);

}  // namespace tyglab
