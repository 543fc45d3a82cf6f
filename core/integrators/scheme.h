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
/// the assignments of `before`, take these two vectors c_x and c_v to the solution of
/// x = c_x + solves·dt·v, v = c_v + solves·dt·a(x, v), then assign (what is assigned then does not name a).
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
  double damps = 0;       ///< not 0: instead of evaluating a, takes r in vectors[velocity] to the solution s of
                          ///< (1 + damps·dt·C) s = r, where -C v is what damping adds to a
};

/// What a method that chooses its own steps knows of the step it has just tried, as sums of state vectors.
struct Estimate {
  int order;                                    ///< power of dt with which the error of a step falls
  std::vector<Term> x, v;                       ///< error of the step, m and m/s
  std::vector<Term> stage_x, stage_v, stage_a;  ///< by how much the last two stages differ, both at the step's end
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
  newton,       ///< to the end: by Newton's method or an interior-point method
  alternation,  ///< by `iterations` alternations of a local and a global step: projective dynamics
  blocks,       ///< by `iterations` passes in which each particle solves for itself: vertex block descent
};

/// Vector 0 changes in the last sweep alone, or in the only one: bodies act on the way from the old to the new
/// position. Where there is an `estimate`, dt is covered with as many steps as the tolerance asks, the first assignment
/// of every sweep keeps its a, the last sweep's a is the next step's first, and all other assignments of the last sweep
/// wait until the step is accepted.
struct Scheme {
  std::string_view name;      ///< in presets and on the command line
  std::string_view title;     ///< for people
  std::string_view equation;  ///< number in the report
  std::string_view source;
  int order_undamped;          ///< of the whole method (position and velocity), k_d = 0, smooth forces
  int order_damped;            ///< k_d > 0
  int vectors;                 ///< state vectors that it keeps
  bool keeps_displacement;     ///< vector 1 is d = dt·v, not v
  std::string_view note;       ///< a sentence said where it is offered
  std::string_view stability;  ///< what is known of it, a clause
  std::string_view cost;       ///< of a step, a clause
  std::string_view formula;    ///< a paragraph for docs/integrators.md, with TeX
  std::vector<Sweep> sweeps;
  /// What the vectors become at the start, in order, from x in vector 0, v in vector 1 and a(x, v); none: these are
  /// kept.
  std::vector<Assignment> start;
  double lag;  ///< vector 1 lacks the end of the last kick: lag·dt·a(x, v) more is the velocity at the position
  std::optional<Estimate> estimate = {};  ///< it chooses its own steps
  /// And the number of their stages: a table for each, from the fewest to the most; `sweeps` are those of the first.
  /// All use the same vectors, and their first sweeps and their last ones make as many assignments.
  std::vector<StageTable> tables = {};
  Solver solver = Solver::newton;  ///< of the sweeps that solve
};

std::span<const Scheme> schemes();
/// The vector that damping sees where a step begins: v itself or a prediction of it.
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
/// Whether a step of a cloth may end before its equations are solved: where what solves them is the step's end, as it
/// is of implicit Euler. Methods that extrapolate from there enlarge what is left.
inline bool can_end_early(const Scheme& scheme) {
  return is_implicit(scheme) && scheme.sweeps.size() == 1 && scheme.order_undamped == 1;
}
/// Whether it covers dt with as many steps as the tolerance asks.
inline bool chooses_steps(const Scheme& scheme) {
  return scheme.estimate.has_value();
}
/// Whether it chooses the number of their stages too (stabilized.h).
inline bool is_stabilized(const Scheme& scheme) {
  return !scheme.tables.empty();
}
/// Whether it projects positions on the springs' lengths: then no amplification matrix says what a step does.
inline bool projects(const Scheme& scheme) {
  return scheme.sweeps.back().projects;
}
/// Whether damping alone is taken implicitly: a linear system with a matrix that no motion changes.
inline bool solves_damping(const Scheme& scheme) {
  return scheme.sweeps.back().damps != 0;
}
/// Whether a step solves equations of any kind (SolveCounts).
inline bool solves_equations(const Scheme& scheme) {
  return is_implicit(scheme) || solves_damping(scheme);
}
/// Whether `iterations` bounds what a step does.
inline bool iterates(const Scheme& scheme) {
  return is_implicit(scheme) || projects(scheme);
}
/// Whether a step makes as many passes over its equations as `iterations` says, whatever they leave.
inline bool counts_passes(const Scheme& scheme) {
  return scheme.solver != Solver::newton;
}
/// Whether linear theory can say from which dt on the method is unstable (infinity where it is at none).
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
  std::int64_t rounded = 0;      ///< those of them in which only more digits of the positions could help
  std::int64_t ended_early = 0;  ///< steps that ended because their time was up (Engine::limit_steps)
  double longest_limited = 0;    ///< real time of the longest step that had a limit (Engine::limit_steps), s
  double worst_residual = 0;     ///< of all steps, in parts of the largest force; may be infinite
};

}  // namespace tyglab
