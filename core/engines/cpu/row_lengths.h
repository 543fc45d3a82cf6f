// Lengths of the springs that a row owns in one direction, in SIMD: what tearing looks at.
#pragma once

#include <cstddef>

namespace tyglab::cpu {

/// The largest |x[j + other] - x[j]|² for begin <= j < end, m²; ∞ or NaN if one of them is. `x` is a row as in
/// row_field.h, `other` leads to the springs' other ends.
template <class R>
R longest_squared(const R* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end);

}  // namespace tyglab::cpu
