// The present values of the particles as a CSV: the numbers that color the cloth.
#pragma once

#include <string>

#include "core/simulation.h"

namespace tyglab {

/// A comment with t, steps and the preset's hash, then `i,j` and a column for each ParticleField with its unit, and a
/// row per particle. `reference`: what distances are measured from; null: there is no such column.
std::string values_csv(Simulation& cloth, Simulation* reference);

}  // namespace tyglab
