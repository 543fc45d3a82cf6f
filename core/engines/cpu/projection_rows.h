// One row of springs, or a pair of rows joined by them, in SIMD: what extended position-based dynamics and its damping
// do with springs of which no two share a particle, so that all can be worked on at once.
#pragma once

#include <cstddef>

namespace tyglab::cpu {

/// Springs of one direction and colour. Between two rows: spring n joins the particles at a[n] and b[n]. Within one row
/// (`reach` 1 or 2): a and b are the same row, from its first particle of that colour on, and the particles are joined
/// in groups of 2·reach: n and n + reach. Components are `stride` apart.
template <class R>
struct SpringRow {
  std::ptrdiff_t stride = 0;
  int count = 0;  ///< springs; within a row: particles
  int reach = 0;  ///< 0: between two rows
  /// 1, or 0 for pinned and held particles, and `whole` 1, or 0 for torn springs; all or none of them are there. whole
  /// stands at the spring's a.
  const R *free_a = nullptr, *free_b = nullptr, *whole = nullptr;
};

/// The projection of positions x + q on the springs' rest length, softened by their compliance.
template <class R>
struct ProjectionRow : SpringRow<R> {
  const R *x_a = nullptr, *x_b = nullptr;  ///< positions at the beginning of the step
  R *q_a = nullptr, *q_b = nullptr;        ///< displacements since then
  R* lambda = nullptr;                     ///< of each spring, times dt²/m: m; within a row at both of its ends
  double rest = 0;                         ///< m
  double compliance = 0;                   ///< m/(k dt²)
  bool pushes = false;                     ///< λ >= 0; otherwise λ <= 0: it pulls
};
template <class R>
void project_row(const ProjectionRow<R>& row);

/// Relative velocities die out exactly as the damping of each spring alone would have it.
template <class R>
struct DampingRow : SpringRow<R> {
  R *v_a = nullptr, *v_b = nullptr;
  double both = 0;  ///< part of the relative velocity that each end takes over where both are free
  double one = 0;   ///< where the other end is fixed
};
template <class R>
void damp_row(const DampingRow<R>& row);

}  // namespace tyglab::cpu
