// Updates of a row after its force is known, in SIMD, for methods whose update is not part of the pair sweep.
#pragma once

#include <cstddef>

#include "core/model/preset.h"

namespace tyglab::cpu {

/// target := Σ factor · source; rows as in row_field.h. The target may be one of the sources.
template <class R>
struct RowSum {
  static constexpr int most_terms = 8;
  R* target = nullptr;  ///< as the sources: of the row with offset 0
  int terms = 0;
  const R* source[most_terms] = {};  ///< nullptr: the force
  R factor[most_terms] = {};
};

/// What follows a sweep on each row: sums, made in this order.
template <class R>
struct RowSums {
  static constexpr int most = 8;
  int count = 0;
  RowSum<R> sum[most];
};

/// Rows that follow each other in memory, as in row_field.h, of which the first `columns` particles are used; the rest
/// stays.
struct RowRun {
  std::ptrdiff_t stride = 0;
  int columns = 0, rows = 1;
};

/// Computes the sums for all components. `offset`: elements from the row with offset 0 to the first one; `force`: the
/// first of the rows that sources of nullptr stand for.
template <class R>
void make_sums(const RowSums<R>& sums, std::ptrdiff_t offset, const R* force, RowRun run);

/// Updates `largest`, a vector of the widest kind, to the largest component of a displacement x - old or dt·v so far,
/// m; one that is not finite makes it ∞ or NaN.
template <class R>
void watch_displacements(const R* x, const R* old, const R* v, R dt, RowRun run, R* largest);

/// Five sums of the same sources: the error of a step in x and v, and how much its last two stages differ in x, v and
/// a.
template <class R>
struct RowEstimate {
  static constexpr int most_terms = 8;
  int terms = 0;
  const R* source[most_terms] = {};
  R error_x[most_terms] = {}, error_v[most_terms] = {};
  R stage_x[most_terms] = {}, stage_v[most_terms] = {}, stage_a[most_terms] = {};
  const R* x = nullptr;  ///< positions
  R dt = 0;              ///< s; turns an error in v into a displacement
};
/// Measures of a row: largest |component|, m, and sums over all components.
struct RowMeasures {
  double error = 0;  ///< of error_x and dt·error_v; ∞ if one is not finite
  double farthest = 0;
  double xx = 0, xv = 0, vv = 0, xa = 0, va = 0;
};
template <class R>
RowMeasures measure_row(const RowEstimate<R>& estimate, std::ptrdiff_t stride, int columns);

}  // namespace tyglab::cpu
