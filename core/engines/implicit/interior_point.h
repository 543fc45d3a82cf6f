// A primal-dual interior-point method for an implicit stage in which springs switch so often that Newton's method
// stalls. Except for bending, the solution x of x = c_x + h v, v = c_v + h a(x, v) minimizes
//
//   ½ |x - y|² + Σ ½ k max(r - L, 0)² + ½ k_d Σ |x_ij - c_ij|²,   y = c_x + h c_v + h² F/m,
//
// with all forces multiplied by h²/m, where r is the length of a stretch spring and F the force without springs. With a
// tension t and a slack s for each of these springs, the conditions are: the forces t along the springs balance all
// others, r - L - t/k + s = 0, t s = 0, t >= 0, s >= 0. Newton's method for t s = μ never meets a switch, and μ goes to
// 0. Each iteration solves twice with one matrix, which has the stiffness k t/(t + k s) along a spring and t/r across
// it: once for μ = 0, and once for the μ that this result allows, including the products left out before (S. Mehrotra,
// SIAM J. Optim. 2, 575 (1992)). Conjugate gradients with multigrid (multigrid.h) solve the linear systems. Convergence
// means that the forces of the model itself balance, without t and s.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/engines/balance.h"
#include "core/engines/implicit/barrier_rows.h"
#include "core/engines/implicit/crew.h"
#include "core/engines/implicit/multigrid.h"
#include "core/forces/linear_springs.h"
#include "core/integrators/scheme.h"

namespace tyglab::implicit {

/// `R`: precision of the linear systems.
template <class R>
class InteriorPoint {
 public:
  using Field = RowField<double>;

  struct Task {
    BarrierConstants constants;
    double gravity;    ///< h² g, m
    double weight;     ///< weight_scale()
    double tolerance;  ///< of the largest residual, in parts of the largest force
    const Tears* tears;
    const LinearSprings<double>& linear;  ///< times h²/m, with rows of row_stride<double>()
    double linear_stiffness;              ///< the most that these resist a particle's motion with
    std::span<const std::uint8_t> fixed;  ///< 1 at i·columns + j if fixed; empty if none is
    /// Adds h² F/m of forces that depend on positions otherwise than by springs, m; may be empty.
    std::function<void(const Field& x, Field& forces)> others;
    std::function<bool()> stops;
    std::function<bool(double best)> out_of_time;  ///< whether to end, where `best` is the least residual so far
    std::function<void(double part)> progress;
    Crew& crew;
  };
  /// Takes the memory for a lattice. Returns false where it was stopped on the way.
  bool resize(const Lattice& lattice, const std::function<bool()>& stops);
  /// To be written before solve(): c_x, y, and where to begin with fixed particles at their places, each array as in
  /// row_field.h; the last is then the best that was found.
  Field& c() { return c_; }
  Field& y() { return y_; }
  Field& x() { return x_; }
  /// Adds its iterations to the counts. Where it was stopped, the result means nothing; where its time was up, it is
  /// the best that was found until then.
  Balance solve(const Task& task, SolveCounts& counts);
  std::size_t bytes() const;

 private:
  struct Products {
    int first = 0;  ///< row of the lattice that is row 0 of q
    RowField<R> q;
  };
  template <class Work>
  void for_rows(const Work& work);
  void begin();
  void find_whole_springs();
  void find_curving();
  BarrierRow row(int i);
  /// The model's residual and the linear system at the present x, unless it stops. Returns Σ tension · slack.
  double linearize();
  bool solve_linear(double tolerance, bool warm);
  template <class Work>
  double together(const Work& work);
  void descend(int number, bool first);
  void subtract_product(int number, bool warm);
  void multiply(Products& products, const RowField<R>& p, int i);
  void make_product(int number, const RowField<R>& z, double keep);
  BarrierStep find_step(bool corrects, double mu);
  void advance(double primal, double dual);
  double allowed() const;
  std::ptrdiff_t fast_stride() const { return step_.pitch() / 3; }

  const Task* task_ = nullptr;
  SolveCounts* counts_ = nullptr;
  Lattice lattice_{0, 0};
  int stride_ = 0;
  Field c_, y_, x_, best_, forces_, right_, moved_;
  Array<double> tension_, slack_, d_tension_, d_slack_, whole_, free_;
  bool torn_ = false;
  double springs_ = 0;               ///< stretch springs
  double residual_ = 0, force_ = 0;  ///< the largest, m
  Balance best_balance_;             ///< of best_
  double size_ = 0;                  ///< largest coordinate, m
  /// Of the linear systems. Products are made by rows and leave parts in those below: each thread makes its own and,
  /// again, the two rows above them.
  RowField<R> step_, r_, p_;
  std::vector<Products> products_;                                   ///< of each thread
  std::vector<double> right_squares_, left_squares_, along_, fall_;  ///< Σ of each row: b·b, r·r, p·q, r·z
  double last_fall_ = 0, next_fall_ = 0;                             ///< Σ r·z of the last step and of this one
  bool falls_ = false;                                               ///< this step does, as it must
  Array<R> coefficients_;
  Array<R> curving_;  ///< of the multigrid; empty without forces that are linear in positions
  Multigrid<R> multigrid_;
};

}  // namespace tyglab::implicit
