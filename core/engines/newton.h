// Newton's method with line search for the implicit stage of a method, x = c_x + h v, v = c_v + h a(x, v) with h = β
// dt. It works with any engine, since the vectors stay there and it requests only sums of them. Preconditioned
// conjugate gradients solve the linear systems, or a direct solver if these do not converge.
//
// Stretch springs only pull, so their potential is convex. A compressed bending spring would make the system
// indefinite, so only its stiffness along the spring is included, which affects how fast Newton's method converges but
// not the solution. Likewise, the linear system leaves out the wind. D. Baraff, A. Witkin, SIGGRAPH 1998; J. Nocedal,
// S. J. Wright, Numerical Optimization, 2nd ed. (2006), 7.1.
#pragma once

#include <cassert>
#include <functional>

#include "core/cloth/lattice.h"
#include "core/engines/balance.h"
#include "core/engines/engine.h"

namespace tyglab {

inline constexpr double linear_tolerance = 1e-3;  ///< of conjugate gradients, relative to the initial |r|
/// Upper bound on their iterations.
constexpr int max_gradient_steps(const Lattice& lattice) {
  return 200 + 20 * (lattice.rows + lattice.columns);
}

/// Diagonal of A without the springs.
inline double own_stiffness(const Preset& preset, double h) {
  assert(preset.m > 0 && h > 0);
  return preset.kind == Kind::one_weight ? 1 + (h * preset.k_d + h * h * preset.k) / preset.m : 1;
}

/// How long a stage may take.
struct StageLimit {
  double seconds = 0;                     ///< of a step; 0: no limit
  std::function<bool(double)> is_over{};  ///< whether this part of the stage's time is; empty: no limit
};

/// An implicit stage, as an engine stores it. The residual r is h a - (v - c_v), m/s; the step s, m/s, solves A s = r
/// with r's derivative -A.
class ImplicitStage {
 public:
  virtual ~ImplicitStage() = default;
  /// |c_x|, m.
  virtual double start_size() = 0;
  /// Updates x = c_x + h v and r; returns |r|.
  virtual double evaluate() = 0;
  /// Computes A at the present x and v.
  virtual void linearize() = 0;
  /// Solves for s by conjugate gradients, leaving r as it is. Returns whether they converged.
  virtual bool gradients() = 0;
  /// Solves for s by a factorization. Returns false if it would take too long or does not exist.
  virtual bool solve_directly() = 0;
  struct Step {
    double slope, size;  ///< r·s and |s|
  };
  /// The step just found, along which try_part() goes.
  virtual Step step() = 0;
  struct Trial {
    double residual, slope;  ///< |r| and r·s
  };
  /// Moves to v + part · s, where v is the velocity at which the step was found, and evaluates r there.
  virtual Trial try_part(double part) = 0;
  /// How well the forces balance at the present x and v.
  virtual Balance balance() = 0;
  /// Whether to abandon the stage, which may then be left anyhow. Once it says so it goes on to say so.
  virtual bool stops() = 0;
  /// Whether to end the stage with what has been found, which should be something.
  virtual bool out_of_time() { return false; }
  /// Tells how much of the stage is done, 0 to 1, if the iterations that are allowed are all needed.
  virtual void note_progress(double part) = 0;
  /// Newton iteration `n` of at most `most` begins.
  void begin_iteration(int n, int most) {
    assert(n >= 0 && n < most);
    done_ = double(n) / most, share_ = 1.0 / most;
    note_progress(done_);
  }

 protected:
  /// gradients() has made this part of the iterations that it may make.
  void note_gradients(double part) { note_progress(done_ + part * share_); }

 private:
  double done_ = 0, share_ = 1;  // of the stage
};

struct NewtonRules {
  int most;           ///< iterations; 1: one linear system, whose solution is taken as it is
  double tolerance;   ///< relative to the initial |r|, where the iteration ends
  double epsilon;     ///< of the precision in which the stage is stored
  double h;           ///< s
  double enough = 0;  ///< |r| at which the iteration ends, too, m/s
};
template <class R>
constexpr double newton_tolerance = sizeof(R) == 8 ? 1e-10 : 1e-5;

/// Solves the stage, unless it stops. Adds to the counts everything but the iterations of conjugate gradients and what
/// concerns whole steps. Returns how well the forces balance in the end.
Balance solve(ImplicitStage& stage, const NewtonRules& rules, SolveCounts& counts);

}  // namespace tyglab
