// Solves the implicit stage of a method: x = c_x + β dt v, v = c_v + β dt a(x, v), by Newton's method with line search,
// its linear systems by preconditioned conjugate gradients that store no matrix (stiffness.h), or, where those do not
// get there, by a banded factorisation (banded.h).
//
// Stretch springs pull only, so their potential is convex; bending springs push, and a compressed one would make the
// system indefinite: of its stiffness only the part along the spring is taken, which changes how quickly Newton's
// method converges and not what it converges to. Likewise the wind, which the linear system leaves out. D. Baraff, A.
// Witkin, SIGGRAPH 1998; J. Nocedal, S. J. Wright, Numerical Optimization, 2nd ed. (2006), 7.1.
#pragma once

#include <functional>
#include <vector>

#include "core/engines/cpu/band.h"
#include "core/engines/cpu/banded.h"
#include "core/engines/cpu/stiffness.h"
#include "core/engines/engine.h"

namespace tyglab::cpu {

template <class R>
class ImplicitSolver {
 public:
  using Field = RowField<R>;
  /// Writes a of the vectors that are being solved for.
  using Accelerations = std::function<void(Field&)>;

  /// Replaces c_x and c_v in the two vectors by the solution; `dt` is β dt. Fixed particles keep their velocity.
  void solve(Cloth<R>& cloth, int position, int velocity, double dt, const Tears& tears,
             const Accelerations& accelerations);
  const SolveCounts& counts() const { return counts_; }
  std::size_t bytes() const;

 private:
  void resize(const Cloth<R>& cloth);
  double evaluate(Cloth<R>& cloth, int position, int velocity, double dt, const Accelerations& accelerations);
  double take_step(Cloth<R>& cloth, int position, int velocity, double dt, const Accelerations& accelerations);
  void linearise(const Cloth<R>& cloth, const Field& x, double dt, const Tears& tears);
  void linearise_row(const Cloth<R>& cloth, const Field& x, double dt, const Tears& tears, int direction, int i);
  void invert_blocks(const Cloth<R>& cloth);
  bool solve_linear(const Cloth<R>& cloth);
  bool conjugate_gradients(const Cloth<R>& cloth);
  bool factorises(const Cloth<R>& cloth) const;
  bool solve_directly(const Cloth<R>& cloth);
  void assemble(const Cloth<R>& cloth);
  double multiply(const Cloth<R>& cloth);
  Residual update(const Cloth<R>& cloth, double alpha);
  double inner(const Field& a, const Field& b) const;
  R* block(int i) { return blocks_.data() + std::size_t(i) * 6 * stride_; }

  int rows_ = 0, stride_ = 0;
  double mass_ = 1;          ///< of A's diagonal beside the springs
  Field start_x_, start_v_;  ///< c_x and c_v
  Field acceleration_, before_;
  Field residual_;  ///< β dt a - (v - c_v), m/s; then what conjugate gradients leave of it
  Field step_;      ///< Newton's, m/s
  Field direction_, product_, preconditioned_;
  Array<R> blocks_;  ///< of the diagonal, then their inverses
  Array<R> coefficients_;
  BandedCholesky matrix_;
  std::vector<double> right_side_;
  bool direct_ = false;  ///< gradients have failed in this stage
  SolveCounts counts_;
};

}  // namespace tyglab::cpu
