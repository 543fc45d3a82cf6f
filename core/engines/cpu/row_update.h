// What becomes of a row once the force on it is known, in SIMD: for methods whose step the pair sweep does not make by
// itself.
#pragma once

#include <cstddef>

namespace tyglab::cpu {

/// target := Σ factor · source; rows as in row_field.h, of which the target may be one of the sources.
template <class R>
struct RowSum {
  static constexpr int most_terms = 4;
  R* target = nullptr;
  int terms = 0;
  const R* source[most_terms] = {};
  R factor[most_terms] = {};
};

/// Makes the sum for all components of the row's first `columns` particles; what lies behind them stays.
template <class R>
void make_sum(const RowSum<R>& sum, std::ptrdiff_t stride, int columns);

/// Keeps in `largest`, a vector of the widest kind, the largest component of a way x - old or dt·v so far, m; one that
/// is not finite makes it ∞ or NaN.
template <class R>
void watch_ways(const R* x, const R* old, const R* v, R dt, std::ptrdiff_t stride, int columns, R* largest);

}  // namespace tyglab::cpu
