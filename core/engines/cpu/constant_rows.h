// One row of the Chebyshev iteration for A = 1 + Σ over springs (constant_solve.h), in SIMD.
#pragma once

#include <cstddef>

namespace tyglab::cpu {

/// out = before + ω (x - before + (r - A x)/middle) for free particles, else 0. Rows of x are 3·stride apart, and the
/// two above and below are there, as are the masks of the two rows above.
template <class R>
struct ConstantRow {
  const R *x, *before, *r;
  R* out;
  const R* whole;  ///< of the row: for each direction 1 where the particle owns a spring, `mask_stride` numbers each
  const R* free;
  std::ptrdiff_t stride, mask_stride;
  int columns;
  double stretch, bending, per_middle, omega;
};
template <class R>
void iterate_row(const ConstantRow<R>& row);

}  // namespace tyglab::cpu
