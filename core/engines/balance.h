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

/// What no solution can do better, m: how much rounding a state to its precision changes the force on a particle. Each
/// spring's length is off by about a unit in the last place of its ends' coordinates, its force by k times that, and
/// all of a particle's together by about six standard deviations of what such errors add up to; velocities likewise. As
/// everywhere here, forces are multiplied by h²/m.
struct Digits {
  double epsilon;    ///< of the precision
  double size;       ///< largest coordinate of a position, m
  double way;        ///< h times the largest of a velocity, m
  double stiffness;  ///< h²/m Σ k over the springs that a particle can have
  double damping;    ///< h/m Σ k_d over them
};
inline double last_digits(const Digits& of) {
  assert(of.epsilon > 0 && !(of.size < 0) && !(of.way < 0) && !(of.stiffness < 0) && !(of.damping < 0));
  return of.epsilon * (of.size * of.stiffness + of.way * (1 + of.damping));
}

/// The weight of a particle, m: at least the one that it has on Earth, so that residuals have a scale where nothing
/// else acts.
inline double weight_scale(double g, double h) {
  constexpr double on_earth = 9.82;  // m/s²
  return h * h * std::max(std::abs(g), on_earth);
}

/// What rounding may leave of the largest force in a step that still counts as solved. The shipped presets leave up to
/// 0.02 in float with any implicit method; beyond this a motion is no longer that of the method, whatever the cause.
inline constexpr double most_excused = 0.05;

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
  double digits;   ///< last_digits(), or 0 where these excuse nothing
  bool weightless;
};
/// The residual of a stage, and whether it counts as solved: within `tolerance`, to which rounding may add the last
/// digits, up to most_excused.
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
