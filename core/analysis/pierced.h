// Springs that lie across a body: only particles meet bodies, so a body that is small beside the spacing comes through
// the cloth between them.
#pragma once

#include <string>

#include "core/simulation.h"

namespace tyglab {

struct Pierced {
  int springs = 0;  ///< whole stretch springs that lead through a body
  int body = -1;    ///< the one that most of them lead through; -1: none
};

/// Counts the springs whose straight line leads through a body, from one side to the other: deeper than half of what
/// its deepest point has, or than 3/4 L. A cloth of rest length that lies on a sphere of r ≥ L, or over the edge of a
/// box at least 2 L thick, has none. Springs with an end that is pinned, held or inside a body are left out: those pass
/// through bodies. One look at all positions.
Pierced pierced_springs(const Simulation& simulation);

/// A sentence about such springs, and what helps; empty if there are none.
std::string pierced_in_words(const Simulation& simulation);

}  // namespace tyglab
