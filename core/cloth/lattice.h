// The lattice: connections between particles, rest lengths, triangles. docs/model.md, "Space and lattice".
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>

namespace tyglab {

/// One of the six half directions in which a particle owns springs. Every spring is owned by its upper end (or its left
/// end within a row), so each has one pair (direction, owner).
struct Direction {
  int di, dj;    ///< from owner to the other end
  double rest;   ///< rest length in units of L
  bool bending;  ///< pushes only; otherwise a stretch spring, which pulls only
};

/// Stretch springs first (bits 0 to 3 of a tear mask), then the two bending ones (bits 4 and 5).
inline constexpr std::array<Direction, 6> directions{{
    {0, 1, 1.0, false},                  // E
    {1, 0, 1.0, false},                  // S
    {1, 1, 1.4142135623730951, false},   // SE
    {1, -1, 1.4142135623730951, false},  // SW
    {0, 2, 2.0, true},                   // E E
    {2, 0, 2.0, true},                   // S S
}};
inline constexpr int stretch_directions = 4;
enum : std::uint8_t { bit_E = 1, bit_S = 2, bit_SE = 4, bit_SW = 8, bit_EE = 16, bit_SS = 32, all_springs = 63 };

/// A spring by its owner and the direction, an index of `directions`, in which the owner has it.
struct SpringSite {
  int direction = 0;
  int i = 0, j = 0;
  bool operator==(const SpringSite&) const = default;
};

/// R x C sites, and rows below them for the copies of a cloth that has parted (mesh.h), which no spring of the lattice
/// joins; arrays over all of them have `stride` >= columns elements a row.
struct Lattice {
  int rows = 2;  ///< all of them
  int columns = 1;
  int copy_rows = 0;  ///< those for copies

  int size() const { return rows * columns; }
  bool contains(int i, int j) const { return i >= 0 && i < rows && j >= 0 && j < columns; }
  /// The lattice without rows for copies.
  Lattice sites() const { return {rows - copy_rows, columns}; }
  bool has_site(int i, int j) const { return i < rows - copy_rows && contains(i, j); }
  /// Whether the spring of that direction owned by (i, j) exists (torn or not).
  bool has_spring(int direction, int i, int j) const {
    assert(direction >= 0 && direction < int(directions.size()));
    const Direction& d = directions[direction];
    return has_site(i, j) && has_site(i + d.di, j + d.dj);
  }
  bool operator==(const Lattice&) const = default;
};

/// Corner of a triangle relative to its quad's top-left particle.
struct Corner {
  int di, dj;
};
/// The two triangles of the quad (i, j), counter-clockwise seen from the front (figure 2.7): index [(i + j)
/// odd][which]. The front normal is along (x[i+1,j] - x[i,j]) × (x[i,j+1] - x[i,j]).
inline constexpr std::array<std::array<std::array<Corner, 3>, 2>, 2> quad_triangles{{
    {{{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 1}, {0, 1}}}}},
    {{{{{0, 0}, {1, 0}, {0, 1}}}, {{{1, 0}, {1, 1}, {0, 1}}}}},
}};

// Selects the particles to draw in a cloth that is finer than the picture.

/// Every n-th row and column of a lattice, the last ones included.
struct DrawnSites {
  Lattice whole;
  int every = 1;

  int rows() const { return count(whole.rows); }
  int columns() const { return count(whole.columns); }
  /// Where drawn row i and column j are in the whole cloth.
  int row(int i) const { return std::min(i * every, whole.rows - 1); }
  int column(int j) const { return std::min(j * every, whole.columns - 1); }

 private:
  int count(int all) const {
    assert(every >= 1 && all >= 1);
    return (all - 1 + every - 1) / every + 1;
  }
};

}  // namespace tyglab
