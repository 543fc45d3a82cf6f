// Selects the particles to draw in a cloth that is finer than the picture.
#pragma once

#include <algorithm>

#include "core/cloth/lattice.h"

namespace tyglab {

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
  int count(int all) const { return (all - 1 + every - 1) / every + 1; }
};

}  // namespace tyglab
