// The area of a cloth.
#pragma once

#include "core/simulation.h"

namespace tyglab {

/// Of all whole triangles, m².
double cloth_area(Simulation& simulation);

}  // namespace tyglab
