// The operations of multigrid (multigrid.h) on a row, in SIMD: products with a nine-point operator of 3 x 3 blocks,
// smoothing, restriction and interpolation, and the coarser operator itself.
//
// A block is symmetric: xx, yy, zz, yz, zx, xy. A row of the operator contains the diagonal blocks of its particles,
// then the blocks between a particle and its neighbors to the right, below, below to the right, and between the right
// neighbor and the one below (so every link is read from the column of its left end): thirty arrays, each `stride`
// numbers long, whose elements beyond the last column are 0. At least one such element follows each array.
#pragma once

#include <cstddef>

namespace tyglab::implicit {

inline constexpr int block_parts = 6;
inline constexpr int blocks_of_a_particle = 5;
/// Size of a row of a nine-point operator.
constexpr std::ptrdiff_t operator_pitch(std::ptrdiff_t stride) {
  return blocks_of_a_particle * block_parts * stride;
}

/// One row of q = A p; rows as in row_field.h.
template <class R>
struct BlockProduct {
  const R* blocks;  ///< of the row
  const R* p;       ///< row i; one more row follows, zeros behind the last
  R* q;             ///< rows i and i+1; row i has what the row above added, and is completed
  std::ptrdiff_t stride;
  int columns;
  bool first;  ///< row 0: row i of q is not initialized
};
template <class R>
void multiply_blocks_row(const BlockProduct<R>& task);

/// One row of a step of Chebyshev's iteration: r -= q, d = keep·d + scale·B r, x += d, with the inverse blocks B on the
/// diagonal, which are 0 at fixed particles; their r becomes 0.
template <class R>
struct SmoothTask {
  const R *q, *inverse;
  R *r, *d, *x;
  std::ptrdiff_t stride;
  int columns;
  double keep, scale;
};
template <class R>
void smooth_row(const SmoothTask<R>& task);

/// The same with q = 0, d = 0 and x = 0 before it.
template <class R>
void start_smoothing_row(const SmoothTask<R>& task);

/// r -= q alone.
template <class R>
void subtract_row(const SmoothTask<R>& task);

/// One row of a step of conjugate gradients: x += part·d, r -= part·q where a particle is not fixed. Returns Σ r·r.
template <class R>
double descend_row(const SmoothTask<R>& task, double part);

/// Inverts the blocks on the diagonal of a row; of a particle without any, all numbers are 0.
template <class R>
void invert_blocks_row(const R* blocks, R* inverse, std::ptrdiff_t stride, int columns);

/// A row to a lattice with every other column: t(J) = p(2J) + ½ (p(2J-1) + p(2J+1)), each of the `parts` arrays of a
/// row. p begins with the element before the first column, which is 0.
template <class R>
void restrict_columns(const R* p, std::ptrdiff_t stride, R* t, std::ptrdiff_t coarse_stride, int coarse_columns,
                      int parts);

/// The way back: p(2J) = t(J), p(2J+1) = ½ (t(J) + t(J+1)).
template <class R>
void prolong_columns(const R* t, std::ptrdiff_t coarse_stride, R* p, std::ptrdiff_t stride, int columns, int parts);

/// sum = a·p + b·q over `count` numbers.
template <class R>
void combine_rows(double a, const R* p, double b, const R* q, R* sum, int count);

/// x += d, d = p where a particle is not fixed, and d = 0 where it is.
template <class R>
void add_correction_row(const R* p, const R* inverse, R* d, R* x, std::ptrdiff_t stride, int columns);

/// What the springs that begin in a row (stiffness.h) add to the blocks on the diagonal of rows i, i+1 and i+2, each
/// six arrays of `stride` numbers.
template <class R>
void diagonal_row(const R* coefficients, R* diagonal, std::ptrdiff_t stride, int columns);

/// What the springs that begin in a row (stiffness.h) make of a nine-point operator. A bending spring is spread over
/// its two halves, each with twice its stiffness.
template <class R>
struct NinePointTask {
  const R* coefficients;  ///< row i of stiffness.h
  const R* above;         ///< row i - 1; null: there is none
  std::ptrdiff_t stride;
  int columns;
  const R *free, *free_below;  ///< 1 at a free particle, 0 at a fixed one and beyond the last column
  R* row;                      ///< of the operator; its diagonal has what the row above added, and is completed
  R* below;                    ///< the next row, whose diagonal this one begins
  std::ptrdiff_t row_stride;
  double m;  ///< of a particle, on the diagonal
};
template <class R>
void nine_point_row(const NinePointTask<R>& task);

/// A row of Pᵀ A P for interpolation between every other column.
template <class R>
void coarsen_columns(const R* row, std::ptrdiff_t stride, R* coarse, std::ptrdiff_t coarse_stride, int coarse_columns);

/// A row of Pᵀ A P for interpolation between every other row: `above`, `at`, `below` are rows 2I-1, 2I and 2I+1, zeros
/// where there are none.
template <class R>
void coarsen_rows(const R* above, const R* at, const R* below, R* coarse, std::ptrdiff_t stride, int columns);

}  // namespace tyglab::implicit
