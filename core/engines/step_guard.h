// Finds the first bad step without examining every step. A spring grows by no more than its two ends move, so after all
// springs have been measured, it is known how much motion can pass before one can be too long or overloaded. Each step
// uses up some of these budgets, and only when one is exhausted is the cloth examined again. The motion divided by dt
// bounds every speed, so speeds are summed only if all particles at that speed would have more energy than the scene
// can contain (MotionLimit). The state is backed up now and then: if a step turns out to be bad, or if later steps have
// overwritten the step to be examined, the engine returns to the backup and repeats the good steps, which gives
// identical bits.
#pragma once

#include <cassert>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>

#include "core/cloth/state.h"
#include "core/engines/engine.h"
#include "core/engines/fault.h"
#include "core/engines/motion_limit.h"

namespace tyglab {

/// How a batch of steps ended.
enum class BatchEnd {
  complete,
  fault,       ///< the step after those that count diverged; the state is the one after it
  released,    ///< in the last step the hand's force exceeded F_release
  overloaded,  ///< after the last step springs part the cloth (GuardedSteps::tear_overloaded)
  stopped,     ///< from outside; where steps are costly, within the step after those that count
  rolled_back  ///< the last step that counts must be examined, but later ones have overwritten its state
};

/// The guard's verdict on a batch of steps.
struct BatchResult {
  int count = 0;  ///< steps that count
  BatchEnd end = BatchEnd::complete;
};

/// What an engine measures in a step, for the guard.
struct StepMeasures {
  double elongation = 0;                 ///< by which any spring can have grown at most, m; may be non-finite
  double dt = 1;                         ///< s
  int left_inside = 0;                   ///< free particles inside a body
  std::optional<glm::dvec3> hand_force;  ///< on the held particle, N, if there is one
  std::optional<double> tear_budget;     ///< as of tear_overloaded(), if the step itself has broken springs
  double residual = 0;                   ///< of equations that the step has solved, as Balance has it
  bool converged = true;                 ///< whether that counts as solved
  bool rounded = false;                  ///< no: by the last digits of positions alone
  double limited_seconds = 0;            ///< real time it took, where that has a limit
};

/// The functions of an engine that the guard calls.
class GuardedSteps {
 public:
  GuardedSteps() = default;
  GuardedSteps(const GuardedSteps&) = delete;
  GuardedSteps& operator=(const GuardedSteps&) = delete;

  /// Makes up to `most` steps, has the guard check() them, and returns its verdict on all of them together.
  virtual BatchResult make_steps(int most, Tears& tears, Fault& fault) = 0;
  /// Measures of a step that is being checked; the first is 0.
  virtual StepMeasures measures(int step) = 0;
  /// Breaks the springs that are overloaded in the present state. Returns by how much any other spring may grow before
  /// it can be overloaded, m. Where a cloth parts instead (parted.h), breaks none, and returns 0 if one parts it.
  virtual double tear_overloaded(Tears& tears) = 0;
  /// Examines every particle and whole spring of the present state, with `tears` brought up to date. If all is well,
  /// sets by how much any spring may grow before it can be too long, m.
  virtual bool find_fault(Tears& tears, Fault& fault, double& divergence_budget) = 0;
  /// Whether the present motion is beyond the limit.
  virtual bool find_runaway(const MotionLimit& limit, Fault& fault) = 0;
  /// Measures the present motion.
  virtual Motion motion(const Tears& tears) = 0;
  /// Copies the present state, in place of an earlier copy.
  virtual void keep_backup() = 0;
  /// Returns to the backup, whose tears are given, and makes that many steps again, all of which are known to be good
  /// but perhaps the last. measures(0) is then that of the last one.
  virtual void repeat(int steps, Tears& tears) = 0;

 protected:
  ~GuardedSteps() = default;
};

/// Whether a particle that is pinned or held (-1: none) will move freely when others are. Pinned ones in rising order.
bool lets_go(std::span<const int> pinned, int held, std::span<const int> next_pinned, int next_held);

class StepGuard {
 public:
  /// A copy of the state costs about as much memory traffic as a step: under 1 %.
  static constexpr int steps_between_backups = 256;

  struct Rules {
    bool tearing = false;  ///< springs can be overloaded
    bool parting = false;  ///< and then part the cloth
    double F_release = 0;  ///< N; 0: the hand does not let go
    /// A step costs more than a backup, and may be stopped halfway: every run of steps begins with a backup, and has
    /// one step where it may be stopped or must not be repeated.
    bool costly_steps = false;
  };
  /// Sets what to watch for. Call invalidate() where the scene has changed.
  void set_rules(const Rules& rules) {
    assert(rules.F_release >= 0);
    rules_ = rules;
  }

  /// Voids the budgets and the backup: something other than the particles' motion has changed the state.
  void invalidate();
  /// Takes constants, wind and hand as they are from now on; of the hand, the velocity of the held particle, m/s.
  void set_scene(const Preset& preset, const Lattice& lattice, const Held& held) {
    assert(held.particle < lattice.size());
    limit_.set_scene(preset, lattice, held.particle >= 0, held.velocity);
  }
  /// The motion begins with this one.
  void begin(const Motion& motion) { limit_.begin(motion), energy_stale_ = pushes_stale_ = false; }
  /// What the motion has been given since it began.
  struct Given {
    MotionLimit limit;
    bool energy_stale = false, pushes_stale = false;
  };
  Given given() const { return {limit_, energy_stale_, pushes_stale_}; }
  /// The motion goes on from where it had been given that, with the same constants and wind. Whatever held a particle
  /// then, `held` does now.
  void resume(const Given& given, const Preset& preset, const Lattice& lattice, const Held& held) {
    limit_ = given.limit, energy_stale_ = given.energy_stale, pushes_stale_ = given.pushes_stale;
    set_scene(preset, lattice, held);
  }
  /// Constants change from some to others: what that does to the springs' energy, or where bodies are now, is measured
  /// before the next step.
  void accept_changes(const Preset& from, const Preset& to);
  /// Bodies may overlap free particles now: that is measured before the next step.
  void expect_pushes() { pushes_stale_ = true; }
  /// MotionLimit::given_squared(); infinity where it is to be measured before the next step.
  double given_squared() const {
    return energy_stale_ || pushes_stale_ ? std::numeric_limits<double>::infinity() : limit_.given_squared();
  }
  /// Whether springs have been cut from outside since the last step.
  bool springs_cut(const Tears& tears) const { return torn_ != tears.torn_count(); }
  /// Takes these tears as known. The budgets stay valid without the springs that were cut, the backup does not.
  void accept_cuts(const Tears& tears) { torn_ = tears.torn_count(), since_backup_ = -1; }

  /// Adds what is known of whole steps alone.
  SolveCounts with_steps(SolveCounts solves) const {
    solves.unconverged = unconverged_steps_, solves.rounded = rounded_steps_;
    solves.worst_residual = worst_residual_;
    solves.longest_limited = longest_limited_;
    return solves;
  }

  /// How many steps, 1 to `most`, can be made before one must be examined, if motion does not suddenly double.
  /// `tears_by_itself`: each step breaks overloaded springs by itself.
  int steps_ahead(int most, bool tears_by_itself = false) const;
  /// Whether a spring may be overloaded within that many steps, while none can be too long in the next.
  bool overload_within(int steps) const;

  /// Makes up to `steps` good steps, as Engine::advance(). `once`: costly ones are never repeated.
  AdvanceResult advance(GuardedSteps& engine, int steps, Tears& tears, const Stop& stop, bool once = false);
  /// Judges steps that have been made, of which the state of the last is present.
  BatchResult judge(GuardedSteps& engine, int count, Tears& tears, Fault& fault);

 private:
  void keep_backup(GuardedSteps& engine, const Tears& tears);
  void spend_budgets();
  void remeasure(GuardedSteps& engine, const Tears& tears);
  void repeat(GuardedSteps& engine, int steps, Tears& tears, int unjudged);
  BatchResult examine_last(GuardedSteps& engine, int count, Tears& tears, Fault& fault);

  Rules rules_;
  double divergence_budget_ = 0;  ///< by which any spring may grow before one can be too long, m
  double tear_budget_ = 0;        ///< before one can be overloaded, m
  double elongation_ = std::numeric_limits<double>::infinity();  ///< of the last step at most, m; ∞: not known
  int since_backup_ = -1;                                        ///< steps; < 0: there is no backup
  bool repeating_ = false;                                       ///< steps that have been judged
  int torn_ = 0;                                                 ///< springs, after the last step
  Tears tears_backup_;
  MotionLimit limit_, limit_backup_;
  bool energy_stale_ = false, pushes_stale_ = false;
  int left_inside_ = 0;
  std::int64_t unconverged_steps_ = 0, rounded_steps_ = 0;
  double worst_residual_ = 0;
  double longest_limited_ = 0;  ///< s
  glm::dvec3 hand_force_{0};
};

}  // namespace tyglab
