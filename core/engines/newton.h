// Newton's method with line search for the implicit stage of a method, x = c_x + h v, v = c_v + h a(x, v) with h = β
// dt, whichever engine holds the vectors: of them it asks for sums alone. Its linear systems are solved by
// preconditioned conjugate gradients, or, where those do not get there, directly.
//
// Stretch springs pull only, so their potential is convex; bending springs push, and a compressed one would make the
// system indefinite: of its stiffness only the part along the spring is taken, which changes how quickly Newton's
// method converges and not what it converges to. Likewise the wind, which the linear system leaves out. D. Baraff, A.
// Witkin, SIGGRAPH 1998; J. Nocedal, S. J. Wright, Numerical Optimization, 2nd ed. (2006), 7.1.
#pragma once

#include "core/cloth/lattice.h"
#include "core/engines/engine.h"

namespace tyglab {

inline constexpr double linear_tolerance = 1e-3;  ///< |r| of its start, where conjugate gradients end
/// Their steps, at most.
constexpr int most_gradients(const Lattice& lattice) {
  return 200 + 20 * (lattice.rows + lattice.columns);
}

/// What A has on its diagonal beside the springs.
inline double own_stiffness(const Preset& preset, double h) {
  return preset.kind == Kind::one_weight ? 1 + (h * preset.k_d + h * h * preset.k) / preset.m : 1;
}

/// A stage as an engine holds it. The residual r is h a - (v - c_v), m/s; the step s, m/s, solves A s = r with r's
/// derivative -A.
class ImplicitStage {
 public:
  virtual ~ImplicitStage() = default;
  /// |c_x|, m.
  virtual double start_size() = 0;
  /// Takes x to c_x + h v and r to what that leaves; returns |r|.
  virtual double evaluate() = 0;
  /// Works A out where the stage is.
  virtual void linearise() = 0;
  /// Solves for s by conjugate gradients, and leaves r as it is. Whether they got there.
  virtual bool gradients() = 0;
  /// Solves for s by a factorisation. False: it would take too long, or does not exist.
  virtual bool solve_directly() = 0;
  struct Step {
    double slope, size;  ///< r·s and |s|
  };
  /// Of the step just found; go() goes along it from here.
  virtual Step step() = 0;
  struct Landing {
    double residual, slope;  ///< |r| and r·s
  };
  /// Goes to v + part · s, with v of where the step was found, and evaluates r there.
  virtual Landing go(double part) = 0;
  /// Takes the step as it is and looks at nothing.
  virtual void take() = 0;
};

struct NewtonRules {
  int most;          ///< steps; 1: one linear system, whose solution is taken as it is
  double tolerance;  ///< |r| of its start
  double epsilon;    ///< of the numbers in which the stage is held
  double h;          ///< s
};
template <class R>
constexpr double newton_tolerance = sizeof(R) == 8 ? 1e-10 : 1e-5;

/// Takes the stage to its solution, and counts what that took but for the steps of conjugate gradients.
void solve(ImplicitStage& stage, const NewtonRules& rules, SolveCounts& counts);

}  // namespace tyglab
