// Distances within a row and from a row, in SIMD, for tearing, divergence and bodies.
#pragma once

#include <cstddef>

namespace tyglab::simd {

/// The largest |x[j + other] - x[j]|² for begin <= j < end, m²; ∞ or NaN if one of them is. `x` is a row as in
/// row_field.h, `other` is the offset to the springs' other ends.
template <class R>
R longest_squared(const R* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end);

/// Σ (|x[j + other] - x[j]| - rest)² over begin <= j < end, m²: of the shorter ones where `pushes`, else of the longer.
template <class R>
double strain_squared(const R* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end, R rest, bool pushes);

/// The smallest distance² of the row's first `columns` particles from a point, m².
template <class R>
R nearest_squared(const R* x, std::ptrdiff_t stride, int columns, const R point[3]);

/// The smallest y of the row's first `columns` particles, m.
template <class R>
R lowest(const R* x, std::ptrdiff_t stride, int columns);

}  // namespace tyglab::simd
