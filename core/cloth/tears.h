// The set of torn springs, allocated only when something tears, so an untorn cloth has no cost.
#pragma once

#include <cassert>
#include <cstdint>
#include <vector>

#include "core/cloth/lattice.h"

namespace tyglab {

/// One mask a particle (row i, column j at i·columns + j): bit d tells whether the spring of direction d that the
/// particle owns is whole. Bits of springs that do not exist are set, and never read.
class Tears {
 public:
  Tears() = default;
  explicit Tears(Lattice lattice) : lattice_(lattice) {}

  const Lattice& lattice() const { return lattice_; }
  bool untorn() const { return masks_.empty(); }
  bool whole(int direction, int i, int j) const {
    return masks_.empty() || (masks_[index(i, j)] >> direction & 1) != 0;
  }
  /// Mask row i, or nullptr while the cloth is untorn.
  const std::uint8_t* row(int i) const { return masks_.empty() ? nullptr : masks_.data() + index(i, 0); }
  /// Breaks a stretch spring and the bending springs over it. Returns whether it was whole.
  bool tear(int direction, int i, int j);
  /// Whether triangle `which` (0, 1) of quad (i, j) has its three edge springs.
  bool triangle_whole(int i, int j, int which) const;
  int torn_count() const { return torn_; }
  std::size_t bytes() const { return masks_.capacity(); }

 private:
  std::size_t index(int i, int j) const {
    assert(lattice_.contains(i, j));
    return std::size_t(i) * lattice_.columns + j;
  }
  Lattice lattice_;
  std::vector<std::uint8_t> masks_;
  int torn_ = 0;  ///< stretch springs
};

}  // namespace tyglab
