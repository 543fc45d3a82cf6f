#include "core/cloth/tears.h"

namespace tyglab {

bool Tears::tear(int direction, int i, int j) {
  if (!lattice_.has_spring(direction, i, j) || !whole(direction, i, j)) return false;
  // Sweeps load whole vectors of masks, of a pair of rows and of the next one: hence the margin.
  if (masks_.empty()) masks_.assign(std::size_t(lattice_.size()) + 2 * lattice_.columns + 128, all_springs);
  masks_[index(i, j)] &= std::uint8_t(~(1u << direction));
  ++torn_;
  // A bending spring lies over two E (or two S) springs: over the torn one and its neighbor on either side.
  if (direction == 0) {
    masks_[index(i, j)] &= std::uint8_t(~bit_EE);
    if (j > 0) masks_[index(i, j - 1)] &= std::uint8_t(~bit_EE);
  } else if (direction == 1) {
    masks_[index(i, j)] &= std::uint8_t(~bit_SS);
    if (i > 0) masks_[index(i - 1, j)] &= std::uint8_t(~bit_SS);
  }
  return true;
}

bool Tears::triangle_whole(int i, int j, int which) const {
  if (masks_.empty()) return true;
  const auto& corners = quad_triangles[(i + j) & 1][which];
  for (int e = 0; e < 3; ++e) {
    const Corner a = corners[e], b = corners[(e + 1) % 3];
    // The owner of the edge is its upper end, or its left end within a row.
    const bool a_owns = a.di < b.di || (a.di == b.di && a.dj < b.dj);
    const Corner from = a_owns ? a : b, to = a_owns ? b : a;
    const int di = to.di - from.di, dj = to.dj - from.dj;
    const int direction = di == 0 ? 0 : dj == 0 ? 1 : dj > 0 ? 2 : 3;
    if (!whole(direction, i + from.di, j + from.dj)) return false;
  }
  return true;
}

}  // namespace tyglab
