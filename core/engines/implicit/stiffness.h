// The cloth's linearized force, row by row and in SIMD: A p for A = M + Σ over springs of (t 1 + a aᵀ) between its
// ends, where t and a describe the resistance of a spring to stretching, rotation and damping. Only t and a are stored.
// This file also has the vector operations of conjugate gradients.
#pragma once

#include <cstddef>

namespace tyglab::implicit {

inline constexpr int springs_of_a_particle = 6;  ///< that it owns, one per direction (lattice.h)
inline constexpr int spring_parts = 4;           ///< a.x, a.y, a.z, t

/// Size of a row of coefficients: for each direction its four parts, `stride` numbers each. Springs to the lower left
/// (SW) are at the column of their lower end, so that all vectors are read from aligned addresses.
constexpr std::ptrdiff_t coefficient_pitch(std::ptrdiff_t stride) {
  return springs_of_a_particle * spring_parts * stride;
}

template <class R>
struct ProductTask {
  const R* coefficients;  ///< of the row
  const R* p;             ///< row i, as in row_field.h; two more rows follow, zeros behind the last
  R* q;                   ///< rows i, i+1, i+2 of the result; row i has what the rows above added, and is completed
  std::ptrdiff_t stride;
  int columns;
  bool first;  ///< row 0: rows i and i+1 of q are not initialized
  double m;    ///< of a particle
};

/// Completes a row of q = A p. Returns the row's Σ p·q.
template <class R>
double multiply_row(const ProductTask<R>& task);

/// One row of a step of conjugate gradients: d += α p, r -= α q, z = B r with the symmetric 3 x 3 blocks B (six numbers
/// per particle: xx, yy, zz, yz, zx, xy; all 0 if it is fixed, and its r becomes 0).
template <class R>
struct UpdateTask {
  const R *p, *q, *blocks;
  R *d, *r, *z;
  std::ptrdiff_t stride;
  int columns;
  double alpha;
};
struct Residual {
  double squared, preconditioned;  ///< Σ r·r, Σ r·z
};
template <class R>
Residual update_row(const UpdateTask<R>& task);

/// y = x + β y for all components of a row of `count` numbers.
template <class R>
void add_scaled_row(const R* x, double beta, R* y, int count);

/// Σ a·b over `count` numbers.
template <class R>
double dot_row(const R* a, const R* b, int count);

}  // namespace tyglab::implicit
