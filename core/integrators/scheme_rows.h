// The parts of the table of methods, which schemes.cpp combines.
#pragma once

#include <vector>

#include "core/integrators/scheme.h"

namespace tyglab {

/// The vectors of a table as its rows write them; used within functions alone, since files are compiled together.
namespace rows {
inline constexpr int x = vector_x, v = vector_v, a = acceleration;
}

std::vector<Scheme> explicit_schemes();
std::vector<Scheme> implicit_schemes();
Scheme dopri5();
Scheme rkc2();
Scheme damped_verlet();
Scheme projective_dynamics();
Scheme vbd();
Scheme xpbd();

}  // namespace tyglab
