// Cholesky factorization of a banded matrix. It solves the linear system of an implicit step directly if a cloth is so
// stiff that conjugate gradients do not converge. With a lattice numbered along its shorter side, no spring spans more
// than two lines. A. George, J. W. Liu, Computer Solution of Large Sparse Positive Definite Systems (1981), 4.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

/// A symmetric positive definite matrix of `size` rows whose elements farther than `band` from the diagonal are 0, in
/// double; after factor() its factor L, A = L Lᵀ, in the same place.
class BandedCholesky {
 public:
  /// Starts a new matrix, all of whose elements are 0.
  void begin(int size, int band);
  /// The element, row >= column, row - column <= band.
  double& at(int row, int column) { return elements_[index(row, column)]; }
  /// Replaces the matrix by its factor. Returns false if it is not positive definite, to rounding, or if it was
  /// stopped.
  bool factor(const Stop& stop = {});
  /// Replaces the right-hand side by the solution.
  void solve(std::span<double> b) const;
  /// The same for four of them at once, each in its place of every element.
  void solve(std::span<std::array<double, 4>> b) const;
  std::size_t bytes() const { return (elements_.capacity() + column_.capacity()) * sizeof(double); }

  /// Approximate number of multiplications in factor().
  static double work(double size, double band) { return size * band * band / 2; }

 private:
  double at(int row, int column) const { return elements_[index(row, column)]; }
  std::size_t index(int row, int column) const {
    assert(row >= column && row - column <= band_);
    return std::size_t(row) * (band_ + 1) + (column - row + band_);
  }

  int size_ = 0, band_ = 0;
  std::vector<double> elements_;  ///< row by row, each from its first element within the band to the diagonal
  std::vector<double> column_;    ///< of L, below the diagonal
};

}  // namespace tyglab
