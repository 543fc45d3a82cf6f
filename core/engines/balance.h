// Measures how well the forces of an implicit stage balance, which defines whether a step has converged.
#pragma once

#include <cassert>
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

/// What no solution can do better, m: what the last digits of the positions of a cloth, whose largest coordinate is
/// `size`, m, make of forces. `stiffness`: k h²/m of its stiffest springs. As everywhere here, forces are multiplied by
/// h²/m.
inline double last_digits(double epsilon, double size, double stiffness) {
  assert(epsilon > 0 && !(size < 0) && !(stiffness < 0));
  return 4 * epsilon * size * (1 + stiffness);
}

struct Balance {
  bool solved = false;
  double residual = 0;  ///< the largest, in parts of the largest force; may be non-finite
};

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
  const R* residual;  ///< h a - (v - c_v), m/s
  std::ptrdiff_t stride;
};

/// The largest force is that of a spring, or the weight of a particle.
template <class R>
Balance balance_of(const StageView<R>& stage);

}  // namespace tyglab
