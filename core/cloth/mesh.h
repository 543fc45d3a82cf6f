// The mesh of a cloth that has parted: its cells, and the particle to which each of their corners is attached.
//
// A cell is a quad of the lattice with its two triangles. In a whole cloth all cells at a site are attached to the
// same particle. Where the cloth parts, some of them get a particle of their own: a copy, with its share of the site's
// mass and springs. A diagonal belongs to its cell, a spring along a row or a column half to the cell on either side of
// it, or wholly to the only one. So no cell is lost, and parting changes neither mass nor energy.
//
// A particle is a number: i·columns + j for those of the sites, and larger ones for copies, in the order of their
// origin.
#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "core/cloth/lattice.h"

namespace tyglab {

class Mesh {
 public:
  static constexpr int cells_round = 4;
  /// Of the cells round a site those above and to the left, above and to the right, below and to the left, and below
  /// and to the right: bits of a set of them.
  enum : unsigned { up_left = 1, up_right = 2, down_left = 4, down_right = 8, all_cells = 15 };

  explicit Mesh(const Lattice& sites) : sites_(sites), fan_of_(std::size_t(sites.size()), -1) {}

  const Lattice& sites() const { return sites_; }
  /// Those of the sites, and copies.
  int particles() const { return sites_.size() + int(site_of_.size()); }
  int copies() const { return int(site_of_.size()); }
  /// The site of a particle, i·columns + j.
  int site(int particle) const {
    assert(particle >= 0 && particle < particles());
    return particle < sites_.size() ? particle : site_of_[std::size_t(particle - sites_.size())];
  }
  /// Whether cells at a site are attached to different particles.
  bool parted(int site) const { return fan_of_[std::size_t(site)] >= 0; }
  /// Sites that have parted, rising.
  std::vector<int> parted_sites() const;
  /// The cells at a site that exist.
  static unsigned cells_at(const Lattice& sites, int site);
  unsigned cells_at(int site) const { return cells_at(sites_, site); }
  /// Those that are attached to a particle.
  unsigned cells_of(int particle) const;
  /// The particle of a site to which one of its cells is attached, by the number of its bit.
  int holder(int site, int cell) const;
  /// The particle at a corner of the cell (i, j).
  int corner(int i, int j, Corner at) const {
    const int site = (i + at.di) * sites_.columns + j + at.dj;
    return parted(site) ? holder(site, 3 - 2 * at.di - at.dj) : site;
  }
  /// The part of its site's mass that a particle has.
  double share(int particle) const;
  /// Gives some of a particle's cells, but not all, to a copy. Returns the copy.
  int part(int particle, unsigned cells);

  std::size_t bytes() const {
    return fan_of_.capacity() * sizeof(int) + fans_.capacity() * sizeof(Fan) + site_of_.capacity() * sizeof(int);
  }
  bool operator==(const Mesh&) const = default;

 private:
  /// The particles to which a site's cells are attached.
  using Fan = std::array<std::int32_t, cells_round>;
  Lattice sites_;
  std::vector<std::int32_t> fan_of_;  ///< of each site; -1: all of its cells are attached to its own particle
  std::vector<Fan> fans_;
  std::vector<std::int32_t> site_of_;  ///< of each copy
};

/// Where cell number `cell` round a site lies: from the site to the cell's upper left corner.
constexpr Corner offset_of_cell(int cell) {
  return {cell / 2 - 1, cell % 2 - 1};
}

}  // namespace tyglab
