// What ends a run: something that is not finite, a spring far too long. Shared by the engines; each looks only when the
// way that particles have gone since the last look says that something might be wrong.
//
// To measure every spring in every step would cost time for what hardly ever happens. So an engine measures all springs
// once, notes by how much the longest could still grow before it counts as diverged, and subtracts twice the largest
// displacement of each step from this budget, since a spring cannot grow by more than its two ends move. Only when the
// budget is used up, or something is not finite, does it look again. The state is backed up every steps_between_backups
// steps; when a look finds a fault, the engine returns to the backup, repeats the good steps, which gives the same
// bits, and stops before the bad one: what is reported is the step that did it, with a state that can still be seen and
// saved. Tearing has a budget of the same kind.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/cloth/lattice.h"
#include "core/cloth/tears.h"
#include "core/model/preset.h"

namespace tyglab {

inline constexpr int steps_between_backups = 256;  ///< a copy of the state costs about a step's traffic: under 1 %

struct Fault {
  int i, j;
  const char* quantity;
  double value;
  int di = 0, dj = 0;
};

/// An engine's x and v, rows as in row_field.h.
template <class R>
struct StateView {
  const R *x, *v;
  std::ptrdiff_t stride;
  static const R* row(const R* field, std::ptrdiff_t stride, int i, int c) { return field + (3 * i + c) * stride; }
  const R* x_row(int i, int c) const { return row(x, stride, i, c); }
  const R* v_row(int i, int c) const { return row(v, stride, i, c); }
};

/// By how much a spring can grow where no component of a particle's way is larger: by both of its ends.
double max_elongation(double max_displacement);

/// Of a length computed in R, as a part of it, generously.
template <class R>
constexpr double rounding = sizeof(R) == 4 ? 16 * 0x1p-23 : 16 * 0x1p-52;

/// Squares of the longest whole springs' lengths, m²: along rows and columns, diagonals, bending springs.
struct LongestSquared {
  double straight = 0, diagonal = 0, bending = 0;
};
/// By how much any spring of a cloth may still grow, m, where these were measured in R. If that is not more than 0, or
/// not a number, find_fault() is to be asked.
template <class R>
double growth_left(const Preset& preset, const LongestSquared& longest);

/// Square of the distance from particle (i, j) to its neighbour in that direction, m².
template <class R>
double distance2(const StateView<R>& state, int i, int j, const Direction& to);

/// Looks at every particle and spring; if all is well, says by how much any spring may still grow, m.
template <class R>
bool find_fault(const Preset& preset, const Lattice& lattice, const Tears& tears, const StateView<R>& state,
                Fault& fault, double& free_motion);

}  // namespace tyglab
