#include "app/render/cloth_renderer.h"

#include <algorithm>
#include <cmath>

namespace tyglab {
namespace {

constexpr double most_per_pixel = 1.5;  ///< of the picture; a framed cloth covers some two fifths of it

}  // namespace

int drawn_every(const Lattice& lattice, int width, int height) {
  const double most = most_per_pixel * std::max(width, 1) * std::max(height, 1);
  return std::max(1, int(std::ceil(std::sqrt(double(lattice.rows) * lattice.columns / most) - 0.01)));
}

void DrawnCloth::take(const ClothScene& scene, int every, bool moved, bool topology_changed) {
  // Of a cloth that has parted the sites alone: copies are nearer to them than a pixel, and their cells are left out.
  if (every != sites_.every || scene.lattice.sites() != sites_.whole) moved = topology_changed = true;
  sites_ = {scene.lattice.sites(), every};
  lattice_ = {sites_.rows(), sites_.columns()};
  if (moved && !scene.writer) take_positions(scene.positions);
  if (topology_changed) take_tears(scene.tears);
}

void DrawnCloth::take_positions(const PositionView& view) {
  positions_.resize(3 * std::size_t(lattice_.size()));
  float* to = positions_.data();
  for (int i = 0; i < lattice_.rows; ++i) {
    const std::size_t from = std::size_t(sites_.row(i)) * view.stride;
    for (int c = 0; c < 3; ++c)
      for (int j = 0; j < lattice_.columns; ++j)
        *to++ = view.f[c] != nullptr ? view.f[c][from + sites_.column(j)] : float(view.d[c][from + sites_.column(j)]);
  }
}

/// Whether one of the springs is torn that lie on the way of a drawn one.
bool DrawnCloth::torn_between(const Tears& tears, int direction, int i, int j) const {
  const Direction& d = directions[direction];
  for (int step = 0; step < sites_.every; ++step) {
    const int at_i = sites_.row(i) + step * d.di, at_j = sites_.column(j) + step * d.dj;
    if (sites_.whole.has_spring(direction, at_i, at_j) && !tears.whole(direction, at_i, at_j)) return true;
  }
  return false;
}

void DrawnCloth::take_tears(const Tears& tears) {
  tears_ = Tears(lattice_);
  if (tears.untorn()) return;
  for (int i = 0; i < lattice_.rows; ++i)
    for (int j = 0; j < lattice_.columns; ++j)
      for (int direction = 0; direction < stretch_directions; ++direction)
        if (lattice_.has_spring(direction, i, j) && torn_between(tears, direction, i, j)) tears_.tear(direction, i, j);
}

ClothScene DrawnCloth::scene(const ClothScene& whole) const {
  PositionView view{lattice_.rows, lattice_.columns, 3 * lattice_.columns};
  if (!positions_.empty())
    for (int c = 0; c < 3; ++c) view.f[c] = positions_.data() + std::ptrdiff_t(c) * lattice_.columns;
  std::function<bool(int, int)> pinned;
  if (whole.pinned) pinned = [this, &whole](int i, int j) { return whole.pinned(sites_.row(i), sites_.column(j)); };
  return {view, lattice_, tears_, whole.preset, pinned, whole.writer};
}

}  // namespace tyglab
