// The systems of constant_solve.h solved directly: their matrix A, which no motion changes, as a band that is
// factorized once. Pinned and held particles stay at 0.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/engines/banded.h"
#include "core/engines/cpu/band.h"
#include "core/forces/force.h"
#include "core/model/preset.h"

namespace tyglab::cpu {

/// β of stretch and of bending springs, and what the constants of LinearSprings are multiplied by.
struct SpringWeights {
  SpringConstants springs;  ///< of the lattice's
  double linear = 0;        ///< what the constants of LinearSprings are multiplied by
  /// Whether springs of one kind, stretching or bending, differ.
  bool differ() const { return linear != 0 || !springs.stretches_alike(); }
  bool operator==(const SpringWeights&) const = default;
};

template <class R>
class LatticeFactor {
 public:
  using Field = RowField<R>;

  /// Distance of the farthest element of A from its diagonal.
  static int band(const Lattice& lattice) { return 2 * std::min(lattice.rows, lattice.columns); }
  /// Approximate number of multiplications in a factorization.
  static double work(const Lattice& lattice) {
    return BandedCholesky::work(double(lattice.rows) * lattice.columns, band(lattice));
  }
  /// Factorizes A. Returns false where rounding makes it no longer positive definite, or where it was stopped.
  bool factorize(const Cloth<R>& cloth, const Tears& tears, const SpringWeights& weights, const Stop& stop = {});
  /// Solves A s = r.
  void solve(const Field& r);
  /// s, in its first three numbers.
  const std::array<double, 4>& solution(int i, int j) const { return sides_[std::size_t(number(i, j))]; }
  /// Σ |r - A s|² over the free particles.
  double residual(const Field& r);
  std::size_t bytes() const {
    return factor_.bytes() + free_.capacity() + springs_.capacity() * sizeof(Spring) +
           (sides_.capacity() + left_.capacity()) * sizeof(std::array<double, 4>);
  }

 private:
  /// The number of a particle, along the lattice's shorter side.
  int number(int i, int j) const {
    assert(lattice_.contains(i, j));
    return lattice_.columns <= lattice_.rows ? i * lattice_.columns + j : j * lattice_.rows + i;
  }

  Lattice lattice_{0, 0};
  BandedCholesky factor_;
  struct Spring {
    int p, q;  ///< its ends' numbers
    double weight;
  };
  std::vector<Spring> springs_;               ///< those that are whole
  std::vector<std::uint8_t> free_;            ///< by number
  std::vector<std::array<double, 4>> sides_;  ///< right-hand sides, then solutions: x, y, z and 0
  std::vector<std::array<double, 4>> left_;   ///< r - A s
};

}  // namespace tyglab::cpu
