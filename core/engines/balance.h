// Measures how well the forces of an implicit stage balance, which defines whether a step has converged.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/model/preset.h"

namespace tyglab {

/// The largest residual force on a particle with which a stage counts as solved, in parts of the largest force.
template <class R>
constexpr double balance_tolerance = sizeof(R) == 8 ? 1e-6 : 1e-4;

/// The smallest residual that a stored solution can have, m: the effect of the last digits of the positions on forces,
/// for a cloth whose largest coordinate is `size`, m. `stiffness`: k h²/m of its stiffest springs. As everywhere here,
/// forces are multiplied by h²/m.
inline double last_digits(double epsilon, double size, double stiffness) {
  assert(epsilon > 0 && !(size < 0) && !(stiffness < 0));
  return 4 * epsilon * size * (1 + stiffness);
}

/// The weight of a particle, m: at least the one that it has on Earth, so that residuals have a scale where nothing
/// else acts.
inline double weight_scale(double g, double h) {
  constexpr double on_earth = 9.82;  // m/s²
  return h * h * std::max(std::abs(g), on_earth);
}

struct Balance {
  bool solved = false;
  double residual = 0;   ///< the largest, in parts of the largest force; may be non-finite
  bool rounded = false;  ///< not solved, but no state in this precision could be
  /// Whether there is nothing more to find.
  bool found() const { return solved || rounded; }
};
/// Of two stages of a step.
inline Balance both(const Balance& a, const Balance& b) {
  const bool solved = a.solved && b.solved;
  return {solved, std::max(a.residual, b.residual), !solved && a.found() && b.found()};
}

/// The largest forces of a stage, m.
struct StageForces {
  double left;     ///< residual on a particle
  double largest;  ///< of a spring, or what changes the velocity of a particle
  double weight;   ///< weight_scale()
  double digits;   ///< last_digits()
  bool weightless;
};
/// The residual of a stage, and whether it counts as solved: below `tolerance`, or below the last digits where these
/// are small compared with the largest force.
Balance judge(const StageForces& forces, double tolerance);

/// A stage x = c_x + h v, v = c_v + h a(x, v), as an engine stores it: each array row by row, its x, then its y, then
/// its z, `stride` numbers each.
template <class R>
struct StageView {
  const Preset& preset;
  Lattice lattice;
  const Tears& tears;
  std::span<const std::uint8_t> fixed;  ///< 1 at i·columns + j if fixed; empty if none is
  double h;                             ///< s
  const R* x;
  const R *v, *c_v;
  const R* residual;  ///< h a - (v - c_v), m/s
  std::ptrdiff_t stride;
};

template <class R>
Balance balance_of(const StageView<R>& stage);

}  // namespace tyglab
