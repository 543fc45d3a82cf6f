// The reasons that end a run: a number that is not finite, a spring that is far too long, or a motion that nothing in
// the scene can have caused. Engines check for them only when particles have moved far or fast enough (StepGuard).
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/engines/motion_limit.h"
#include "core/forces/contact.h"
#include "core/model/preset.h"

namespace tyglab {

/// What diverged, as in Divergence.
struct Fault {
  int i, j;
  const char* quantity;
  double value;
  int di = 0, dj = 0;
  double excess = 0;  ///< energy of the motion divided by the most that the scene can contain; 0: not the fault
};

/// A spring that is longer than that many rest lengths has diverged; a mass on a spring, that is farther from x_0 than
/// that many times the larger of L and |offset|.
inline constexpr double longest_factor = 1000;

/// An engine's x and v, rows as in row_field.h.
template <class R>
struct StateView {
  const R *x, *v;
  std::ptrdiff_t stride;
  static const R* row(const R* field, std::ptrdiff_t stride, int i, int c) {
    assert(field != nullptr && stride > 0 && i >= 0 && c >= 0 && c < 3);
    return field + (3 * i + c) * stride;
  }
  const R* x_row(int i, int c) const { return row(x, stride, i, c); }
  const R* v_row(int i, int c) const { return row(v, stride, i, c); }
};

/// By how much a spring can grow if no particle moves by more in any component: by the motion of both ends.
double max_elongation(double max_displacement);

/// Relative rounding error of a length computed in R, an upper bound.
template <class R>
constexpr double rounding = sizeof(R) == 4 ? 16 * 0x1p-23 : 16 * 0x1p-52;

/// Squares of the longest whole springs' lengths, m²: along rows and columns, diagonals, bending springs.
struct LongestSquared {
  double straight = 0, diagonal = 0, bending = 0;
};
/// By how much any spring of a cloth may grow before one is too long, m, from lengths measured in R. Unless that is a
/// number over 0, find_fault() must decide.
template <class R>
double growth_left(const Preset& preset, const LongestSquared& longest);

/// Square of the distance from particle (i, j) to its neighbor in that direction, m².
template <class R>
double distance2(const StateView<R>& state, int i, int j, const Direction& to);

/// Examines every particle and spring; if all is well, sets by how much any spring may grow before one is too long, m.
template <class R>
bool find_fault(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state,
                Fault& fault, double& divergence_budget);

/// Measures the present motion among bodies where they are. `to_velocity`: factor that converts stored velocities to
/// m/s.
template <class R>
Motion motion_of(const Preset& preset, const Lattice& lattice, const Tears& tears, std::span<const PlacedBody> bodies,
                 const StateView<R>& state, double to_velocity);

/// Whether all particles together are faster than the scene allows, or one is farther away than it can have traveled.
/// Of several about equally fast particles it names the first, so rounding does not decide.
template <class R>
bool find_runaway(const MotionLimit& limit, const Lattice& lattice, const StateView<R>& state, double to_velocity,
                  Fault& fault);

}  // namespace tyglab
