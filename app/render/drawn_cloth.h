// Selects the visible part of a cloth that is finer than the picture.
#pragma once

#include <vector>

#include "app/render/cloth_renderer.h"
#include "core/cloth/drawn_sites.h"

namespace tyglab {

/// Every how many rows and columns are drawn in a picture of that size, so that no more than about four particles share
/// a pixel of a cloth that fills it as framed: 1 draws all.
int drawn_every(const Lattice& lattice, int width, int height);

/// Every n-th row and column of a cloth, the last ones included, as a cloth of its own.
class DrawnCloth {
 public:
  /// Takes what changed. `every` is 2 or more.
  void take(const ClothScene& scene, int every, bool moved, bool topology_changed);
  /// Valid until the next take(), while the scene that was taken lives.
  ClothScene scene(const ClothScene& whole) const;
  std::size_t bytes() const { return positions_.capacity() * sizeof(float); }

 private:
  void take_positions(const PositionView& view);
  void take_tears(const Tears& tears);
  bool torn_between(const Tears& tears, int direction, int i, int j) const;

  DrawnSites sites_{{}, 0};
  Lattice lattice_;
  Tears tears_;
  std::vector<float> positions_;  ///< laid out as an engine's: a row's x, its y, its z
};

}  // namespace tyglab
