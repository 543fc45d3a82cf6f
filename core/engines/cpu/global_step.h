// The global step of projective dynamics: A s = r with A = 1 + h²/m Σ k L_k + h k_d/m L_s, where L_k and
// L_s are the graph Laplacians of the intact stretch and bending springs, and pinned and held particles stay at 0. One
// matrix A serves x, y and z, independently of the motion. It is factorized once if its factor is small enough and
// faster than products; otherwise the Chebyshev iteration solves. S. Bouaziz et al., ACM Trans. Graph. 33, 154 (2014),
// 3; T. Liu et al., ACM Trans. Graph. 32, 214 (2013).
#pragma once

#include <cstdint>

#include "core/engines/cpu/constant_solve.h"
#include "core/engines/cpu/lattice_factor.h"

namespace tyglab::cpu {

template <class R>
class GlobalStep {
 public:
  using Field = RowField<R>;

  /// Prepares solutions for a stage over h, s. `changed`: whether springs or fixed particles may differ from the last
  /// call. Returns false where it was stopped; the next call starts over.
  bool prepare(const Cloth<R>& cloth, const Tears& tears, double h, bool changed, const Stop& stop);
  /// Replaces r by the solution. Returns how many products with A that took.
  int solve(Field& r, const Stop& stop);
  std::size_t bytes() const { return products_.bytes() + factor_.bytes(); }

 private:
  Lattice lattice_{0, 0};
  bool ready_ = false, factorized_ = false;
  SpringWeights weights_;
  std::uint64_t springs_ = 0;  ///< version of the linear ones
  ConstantSolver<R> products_;
  LatticeFactor<R> factor_;
};

}  // namespace tyglab::cpu
