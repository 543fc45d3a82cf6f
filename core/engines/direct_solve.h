// Solves the linear system of an implicit stage directly if a cloth is so stiff that conjugate gradients do not
// converge: the processor factorizes A of newton.h as a banded matrix, for every engine.
#pragma once

#include <functional>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/engines/banded.h"

namespace tyglab {

/// The 3 x 3 block that a spring adds to A between its ends: t 1 + a aᵀ.
struct SpringStiffness {
  double a[3], t;
};

/// A s = r, as an engine stores it.
struct LinearSystem {
  Lattice lattice;
  double own;  ///< diagonal of A without the springs
  std::function<bool(int i, int j)> fixed;
  std::function<SpringStiffness(int direction, int i, int j)> spring;  ///< the one that (i, j) owns
  std::function<double(int i, int j, int c)> right_side;
};

class DirectSolver {
 public:
  /// Whether a factorization takes no more than about a second.
  static bool is_quick(const Lattice& lattice);
  /// Solves A s = r and passes every component of s to `take`. Returns false if A is not positive definite, to
  /// rounding, or if it was stopped.
  bool solve(const LinearSystem& system, const std::function<void(int i, int j, int c, double s)>& take,
             const Stop& stop);
  std::size_t bytes() const { return matrix_.bytes() + right_side_.capacity() * sizeof(double); }

 private:
  void assemble(const LinearSystem& system);
  void add_spring(const LinearSystem& system, int direction, int i, int j);

  BandedCholesky matrix_;
  std::vector<double> right_side_;
};

}  // namespace tyglab
