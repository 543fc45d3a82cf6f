// Integrators as data. A step consists of a few sweeps. Each evaluates the force on every particle at one pair of state
// vectors, or solves an implicit stage for them, and then replaces some state vectors by linear combinations. One sweep
// in each engine runs all schemes; a new scheme is one row in schemes.cpp.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tyglab {

/// State vectors of a scheme: 0 holds positions, 1 velocities (or, for Verlet, displacements), further ones stages.
inline constexpr int vector_x = 0;
inline constexpr int vector_v = 1;
inline constexpr int acceleration = -1;  ///< stands for a(x, v) of the sweep in a term

/// dt to a small power, which may be negative.
inline double power(double dt, int n) {
  double product = 1;
  for (int k = std::abs(n); k > 0; --k) product *= dt;
  return n < 0 ? 1 / product : product;
}

/// factor · dt^dt_power · vector
struct Term {
  int vector;
  double factor;
  int dt_power;
};

/// target := sum of terms. Assignments of a sweep are made in order, particle by particle.
struct Assignment {
  int target;
  std::vector<Term> terms;
};

/// Evaluate a(vectors[position], vectors[velocity] · dt^velocity_dt_power), then assign. Where `solves` is not 0, make
/// the assignments of `before`, replace these two vectors c_x and c_v by the solution of x = c_x + solves·dt·v, v = c_v
/// + solves·dt·a(x, v), then assign (these assignments do not use a).
struct Sweep {
  int position;
  int velocity;
  int velocity_dt_power;
  std::vector<Assignment> assignments;
  double solves = 0;
  std::vector<Assignment> before = {};
  bool external = false;  ///< a holds gravity and wind alone
  bool projects = false;  ///< instead of evaluating a, projects vectors[position] + vectors[velocity] on the springs'
                          ///< lengths, softened by their compliance; the assignments are followed by a pass of damping
  double damps = 0;       ///< not 0: instead of evaluating a, replaces r in vectors[velocity] by the solution s of
                          ///< (1 + damps·dt·C) s = r, where -C v is what damping adds to a
};

/// The measures of a tried step for methods that choose their own steps, as sums of state vectors.
struct Estimate {
  int order;                                    ///< power of dt with which the error of a step falls
  std::vector<Term> x, v;                       ///< error of the step, m and m/s
  std::vector<Term> stage_x, stage_v, stage_a;  ///< difference of the last two stages, both at the end of the step
  std::vector<double> growth;                   ///< coefficients of R(z): a step takes y of y' = λ y to R(λ dt) y
};

/// A step of a stabilized method with one number of stages: it takes y of y' = λ y to R(λ dt) y.
struct StageTable {
  int stages;
  double reach;  ///< |R(z)| <= 1 for -reach <= z <= 0
  double disc;   ///< and for |z + disc| <= disc
  std::vector<Sweep> sweeps;
};

/// How the equations of an implicit stage are solved.
enum class Solver {
  newton,       ///< to convergence: by Newton's method or an interior-point method
  alternation,  ///< by `iterations` alternations of a local and a global step: projective dynamics
  blocks,       ///< by `iterations` passes in which each particle solves for itself: vertex block descent
};

/// A method. Vector 0 changes only in the last sweep, since bodies act between the old and the new position. With an
/// `estimate`, as many inner steps cover dt as the tolerance requires, the first assignment of every sweep keeps its a,
/// the last sweep's a is the next step's first, and all other assignments of the last sweep wait until the step is
/// accepted.
struct Scheme {
  std::string_view name;      ///< in presets and on the command line
  std::string_view title;     ///< for people
  std::string_view equation;  ///< number in the report
  std::string_view source;
  int order_undamped;          ///< of the whole method (position and velocity), k_d = 0, smooth forces
  int order_damped;            ///< k_d > 0
  int vectors;                 ///< state vectors that it keeps
  bool keeps_displacement;     ///< vector 1 is d = dt·v, not v
  std::string_view note;       ///< a sentence for lists of methods
  std::string_view stability;  ///< its stability, a clause
  std::string_view cost;       ///< of a step, a clause
  std::string_view formula;    ///< a paragraph for docs/integrators.md, with TeX
  std::vector<Sweep> sweeps;
  /// Assignments at the start, in order, from x in vector 0, v in vector 1 and a(x, v); none: these vectors are kept.
  std::vector<Assignment> start;
  double lag;  ///< vector 1 lacks the end of the last kick: lag·dt·a(x, v) more is the velocity at the position
  std::optional<Estimate> estimate = {};  ///< it chooses its own steps
  /// It also chooses the number of stages: one table for each, from the fewest to the most; `sweeps` belong to the
  /// first. All use the same vectors, and their first sweeps and their last ones make as many assignments.
  std::vector<StageTable> tables = {};
  Solver solver = Solver::newton;  ///< of the sweeps that solve
};

std::span<const Scheme> schemes();
/// What a step makes of a constant acceleration a, which contacts within the step ask for.
struct StepShape {
  double position = 0;   ///< x_1 = x_0 + dt·(v + position·dt·a), v: the stored velocity before the step
  double last_kick = 0;  ///< its last sweep adds last_kick·dt·a to the stored velocity
};
StepShape step_shape(const Scheme& scheme);
/// The velocity that damping uses at the beginning of a step: v itself or a prediction of it.
inline int seen_velocity(const Scheme& scheme) {
  const Sweep& first = scheme.sweeps.front();
  return first.solves != 0 ? vector_v : first.velocity;
}
/// Whether a step solves equations.
inline bool is_implicit(const Scheme& scheme) {
  for (const Sweep& sweep : scheme.sweeps)
    if (sweep.solves != 0) return true;
  return false;
}
/// Whether a step of a cloth may end before its equations are solved: only if their solution is the end of the step, as
/// with implicit Euler. Methods that extrapolate from the solution amplify its residual.
inline bool can_end_early(const Scheme& scheme) {
  return is_implicit(scheme) && scheme.sweeps.size() == 1 && scheme.order_undamped == 1;
}
/// Whether it covers dt with as many inner steps as the tolerance requires.
inline bool chooses_steps(const Scheme& scheme) {
  return scheme.estimate.has_value();
}
/// Whether it chooses the number of their stages too (stabilized.h).
inline bool is_stabilized(const Scheme& scheme) {
  return !scheme.tables.empty();
}
/// Whether it projects positions onto the lengths of springs; such a method has no amplification matrix.
inline bool projects(const Scheme& scheme) {
  return scheme.sweeps.back().projects;
}
/// Whether what it solves is of springs alone, so that the forces of the cloth's contact with itself are those at the
/// start of the step.
inline bool lags_contact(const Scheme& scheme) {
  return projects(scheme) || scheme.solver != Solver::newton;
}
/// Whether only the damping is implicit: a linear system whose matrix does not depend on the motion.
inline bool solves_damping(const Scheme& scheme) {
  return scheme.sweeps.back().damps != 0;
}
/// Whether it takes a cloth that parts (parted.h): no matrix of the lattice's alone.
inline bool parts_cloth(const Scheme& scheme) {
  return !lags_contact(scheme) && !solves_damping(scheme);
}
/// Whether a method's sums, evaluation by evaluation, are all of its step: it is explicit, with a fixed dt.
inline bool is_written_out(const Scheme& scheme) {
  return !is_implicit(scheme) && !chooses_steps(scheme) && !projects(scheme) && !solves_damping(scheme);
}
/// Whether a step solves equations of any kind (SolveCounts).
inline bool solves_equations(const Scheme& scheme) {
  return is_implicit(scheme) || solves_damping(scheme);
}
/// Whether `iterations` bounds the work of a step.
inline bool iterates(const Scheme& scheme) {
  return is_implicit(scheme) || projects(scheme);
}
/// Whether a step makes exactly `iterations` passes over its equations, whatever the residual.
inline bool counts_passes(const Scheme& scheme) {
  return scheme.solver != Solver::newton;
}
/// Whether linear theory has a limit of dt for the method (infinity if it is stable at every dt).
inline bool has_step_limit(const Scheme& scheme) {
  return !chooses_steps(scheme) && !projects(scheme) && !counts_passes(scheme);
}
/// The scheme of that name; the name must be known (is_integrator).
const Scheme& scheme(std::string_view name);

// The names of all integrators, separate from the schemes, so presets can be checked without them.

std::span<const std::string_view> integrator_names();
bool is_integrator(std::string_view name);

// Counts the work of implicit solves, and those that did not converge.

/// Work of implicit methods since the engine was created.
struct SolveCounts {
  std::int64_t newton = 0;  ///< iterations of Newton's method, or of the interior-point method in its place
  std::int64_t linear = 0;  ///< iterations of conjugate gradients within them, or products with a constant matrix
  std::int64_t force_evaluations = 0;
  std::int64_t unconverged = 0;  ///< steps whose forces do not balance, in any of their stages
  std::int64_t rounded = 0;      ///< unconverged steps that need more digits of the positions
  std::int64_t ended_early = 0;  ///< steps that reached their time limit (Engine::limit_steps)
  double longest_limited = 0;    ///< real time of the longest step that had a limit (Engine::limit_steps), s
  double worst_residual = 0;     ///< largest of all steps, relative to the largest force; may be infinite
};

}  // namespace tyglab
