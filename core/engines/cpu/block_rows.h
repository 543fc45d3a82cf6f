// Vertex block descent for the particles of one color in a row, in SIMD: each makes a step of Newton's method for the
// energy of implicit Euler's step while all others stay fixed.
#pragma once

#include <array>
#include <cstddef>

namespace tyglab::cpu {

/// A particle's springs: to the six others of lattice.h's directions, and from six.
inline constexpr int links_of_a_particle = 12;

/// Forces and stiffnesses are multiplied by h²/m, those of damping by h/m, so that the mass is 1.
struct BlockConstants {
  double weft, warp, shear, bend, damping;
  double L;       ///< m
  double linear;  ///< what the constants of LinearSprings are multiplied by
};

/// Particles of one color: every fifth of a row, moved together in memory. Components are `stride` apart. Beyond the
/// last particle `free` is 0 up to a whole vector.
template <class R>
struct BlockRow {
  struct Link {
    std::ptrdiff_t to;  ///< from a particle's place to its neighbor's, in c and q alike
    const R* whole;     ///< 1 where there is a spring to it, else 0
    int kind;           ///< 0: weft, 1: warp, 2: a diagonal, 3: a bending spring
    const R* linear;    ///< the constants of LinearSprings; nullptr: there are none
  };
  const R *c, *y, *free;  ///< positions when the step began; where inertia leads, from there; 0 for fixed particles
  R* q;                   ///< displacements since then
  std::ptrdiff_t stride;
  int count;
  std::array<Link, links_of_a_particle> links;
  BlockConstants constants;
};

/// A particle's block of the Hessian has k along an acting spring, and across a stretch spring k(1 - L/r), both at
/// least 0. Where Newton's step would raise the energy, since springs began to act or ceased to on its way, the
/// particle makes the step to the minimum of a quadratic function that lies above the energy everywhere: k in all
/// directions.
template <class R>
void descend_row(const BlockRow<R>& row);

}  // namespace tyglab::cpu
