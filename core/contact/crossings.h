// Where the cloth passes through itself: pairs of its triangles that cross or touch, counted exactly.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/cloth/state.h"
#include "core/contact/triangle_pair.h"
#include "core/model/preset.h"

namespace tyglab {

struct Crossings {
  std::int64_t pairs = 0;
  /// Of these, of triangles around one site that has parted, which no guard keeps apart.
  std::int64_t around_sites = 0;
  /// Numbers of their triangles (triangle_at), the smaller first, rising: of all pairs, or of those found first.
  std::vector<std::array<int, 2>> listed;
  bool complete = true;  ///< whether all triangles were looked at: otherwise there are at least so many pairs
};

/// Ends of the search, which crumpled cloths of many layers can make long.
struct CrossingLimits {
  std::size_t listed = 0;
  std::int64_t tested = std::numeric_limits<std::int64_t>::max();  ///< pairs of triangles, about 0.1 to 1 µs each
  Stop stop = {};                                                  ///< asked now and then
};

/// Counts the pairs of whole triangles (Tears::triangle_whole) that have a point in common which is not of a corner or
/// edge that they share as parts of the lattice. `x`: dense positions, m, at index i·columns + j. None where one of
/// them is not finite.
Crossings count_crossings(const VectorField<double>& x, const Tears& tears, const CrossingLimits& limits = {});

/// A triangle of a lattice: the upper left particle (i, j) of its quad, and which of the two it is there.
struct TriangleSite {
  int i, j, which;
};
/// Triangles are numbered by quad, in row order.
inline int triangle_number(const Lattice& lattice, const TriangleSite& site) {
  return 2 * (site.i * (lattice.columns - 1) + site.j) + site.which;
}
inline TriangleSite triangle_at(const Lattice& lattice, int number) {
  return {number / 2 / (lattice.columns - 1), number / 2 % (lattice.columns - 1), number % 2};
}

}  // namespace tyglab
