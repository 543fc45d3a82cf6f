// One row of springs, or a pair of rows connected by springs, in SIMD: extended position-based dynamics and its damping
// for springs that share no particle, so all are projected simultaneously.
#pragma once

#include <cstddef>

namespace tyglab::cpu {

/// Springs of one direction and color. Between two rows: spring n joins the particles at a[n] and b[n]. Within one row
/// (`reach` 1 or 2): a and b are the same row, from its first particle of that color on, and the particles are joined
/// in groups of 2·reach: n and n + reach. Components are `stride` apart.
template <class R>
struct SpringRow {
  std::ptrdiff_t stride = 0;
  int count = 0;  ///< springs; within a row: particles
  int reach = 0;  ///< 0: between two rows
  /// free: 0 for pinned and held particles, else 1; whole: 0 for torn springs, else 1, at the spring's a. All three are
  /// set, or none.
  const R *free_a = nullptr, *free_b = nullptr, *whole = nullptr;
};

/// The projection of positions x + q on the springs' rest length, softened by their compliance.
template <class R>
struct ProjectionRow : SpringRow<R> {
  const R *x_a = nullptr, *x_b = nullptr;  ///< positions at the beginning of the step
  R *q_a = nullptr, *q_b = nullptr;        ///< displacements since then
  R* lambda = nullptr;                     ///< times dt²/m, of each spring: m; within a row in an order of its own
  double rest = 0;                         ///< m
  double compliance = 0;                   ///< m/(k dt²); soften() sets it
  double per_both = 0.5, per_one = 1;      ///< 1/(2 + compliance) and 1/(1 + compliance): of two free ends, and of one
  bool pushes = false;                     ///< λ >= 0; otherwise λ <= 0: it pulls

  void soften(double by) { compliance = by, per_both = 1 / (2 + by), per_one = 1 / (1 + by); }
};
template <class R>
void project_row(const ProjectionRow<R>& row);

/// The decay of relative velocities, exactly as the damping of each spring alone causes it.
template <class R>
struct DampingRow : SpringRow<R> {
  R *v_a = nullptr, *v_b = nullptr;
  double both = 0;  ///< share of the relative velocity that each end takes over if both are free
  double one = 0;   ///< if the other end is fixed
};
template <class R>
void damp_row(const DampingRow<R>& row);

}  // namespace tyglab::cpu
