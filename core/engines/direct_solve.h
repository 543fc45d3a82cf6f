// The direct way through an implicit stage's linear system, for cloths so stiff that conjugate gradients do not get
// there: A of newton.h as a banded matrix, factorised by the processor whichever engine holds the vectors.
#pragma once

#include <functional>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/engines/banded.h"

namespace tyglab {

/// What a spring adds to A between its ends: t 1 + a aᵀ.
struct SpringStiffness {
  double a[3], t;
};

/// A as an engine holds it.
struct LinearSystem {
  Lattice lattice;
  double own;  ///< of A's diagonal beside the springs
  std::function<bool(int i, int j)> fixed;
  std::function<SpringStiffness(int direction, int i, int j)> spring;  ///< that (i, j) owns
  std::function<double(int i, int j, int c)> right_side;
};

class DirectSolver {
 public:
  /// Whether a factorisation takes no more than about a second.
  static bool pays(const Lattice& lattice);
  /// Solves A s = r and hands every component of s on. False if A is not positive definite, to rounding.
  bool solve(const LinearSystem& system, const std::function<void(int i, int j, int c, double s)>& take);
  std::size_t bytes() const { return matrix_.bytes() + right_side_.capacity() * sizeof(double); }

 private:
  void assemble(const LinearSystem& system);
  void add_spring(const LinearSystem& system, int direction, int i, int j);

  BandedCholesky matrix_;
  std::vector<double> right_side_;
};

}  // namespace tyglab
