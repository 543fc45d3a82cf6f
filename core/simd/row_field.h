// One vector per particle (position, velocity, force …), row by row. Each row has its x, then its y, then its z, so a
// row is contiguous, and the sweep reaches all components from one pointer.
#pragma once

#include <cassert>
#include <cstddef>
#include <span>

#include "core/cloth/array.h"

namespace tyglab::simd {

inline constexpr int widest_vector = 64;  ///< bytes; rows begin at multiples of it

/// Elements per component of a row: whole SIMD vectors, so that every row is aligned, and in long rows an odd number of
/// them. With a power of two, the two dozen rows that the sweep reads and writes at a time would map to the same few
/// lines of the first-level cache (1024 columns: more than 1.5 times as slow).
template <class R>
constexpr int row_stride(int columns) {
  constexpr int lanes = widest_vector / int(sizeof(R)), long_row = 16;
  const int vectors = (columns + lanes - 1) / lanes;
  return (vectors < long_row ? vectors : vectors | 1) * lanes;
}

template <class R>
class RowField {
 public:
  /// `rows` rows of zeros, plus one SIMD vector, since the sweep loads right neighbors before it masks them. `lead`:
  /// cache lines before the first row, so that fields that are swept together have different offsets in their pages: a
  /// load would have to wait for stores to the same offset of another page.
  void resize(int rows, int stride, int lead = 0) {
    stride_ = stride;
    lead_ = std::size_t(lead) * widest_vector / sizeof(R);
    data_.assign(lead_ + std::size_t(rows) * pitch() + widest_vector / sizeof(R), R(0));
  }
  bool empty() const { return data_.empty(); }
  std::ptrdiff_t pitch() const { return 3 * std::ptrdiff_t(stride_); }  ///< from a row to the next
  R* row(int i) { return data_.data() + offset(i); }
  const R* row(int i) const { return data_.data() + offset(i); }
  R* row(int i, int component) { return row(i) + component * std::ptrdiff_t(stride_); }
  const R* row(int i, int component) const { return row(i) + component * std::ptrdiff_t(stride_); }
  /// All rows. In fields of one size, an index means the same component of the same particle.
  std::span<R> all() { return std::span(data_).subspan(lead_); }
  std::span<const R> all() const { return std::span(data_).subspan(lead_); }
  std::size_t bytes() const { return data_.size() * sizeof(R); }

 private:
  std::size_t offset(int i) const {
    assert(i >= 0 && lead_ + std::size_t(i * pitch()) < data_.size());
    return lead_ + std::size_t(i * pitch());
  }

  int stride_ = 0;
  std::size_t lead_ = 0;
  Array<R> data_;
};

}  // namespace tyglab::simd

// Distances within a row and from a row, in SIMD, for tearing, divergence and bodies.

namespace tyglab::simd {

/// The largest |x[j + other] - x[j]|² for begin <= j < end, m²; ∞ or NaN if one of them is. `x` is a row as in
/// row_field.h, `other` is the offset to the springs' other ends.
template <class R>
R longest_squared(const R* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end);

/// Σ (|x[j + other] - x[j]| - rest)² over begin <= j < end, m²: of the shorter ones where `pushes`, else of the longer.
template <class R>
double strain_squared(const R* x, std::ptrdiff_t stride, std::ptrdiff_t other, int begin, int end, R rest, bool pushes);

/// The smallest distance² of a point from the ways of the row's first `columns` particles, straight on from where they
/// were (another row) to where they are, m².
template <class R>
R nearest_squared(const R* from, const R* x, std::ptrdiff_t stride, int columns, const R point[3]);

/// The smallest y of the row's first `columns` particles, m.
template <class R>
R lowest(const R* x, std::ptrdiff_t stride, int columns);

}  // namespace tyglab::simd
