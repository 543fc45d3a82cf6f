#include "core/engines/step_guard.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <new>

#include "core/model/effect.h"

namespace tyglab {

bool lets_go(std::span<const int> pinned, int held, std::span<const int> next_pinned, int next_held) {
  assert(std::is_sorted(next_pinned.begin(), next_pinned.end()));
  assert(next_held < 0 || !std::binary_search(next_pinned.begin(), next_pinned.end(), next_held));
  const auto stays = [&](int p) {
    return p == next_held || std::binary_search(next_pinned.begin(), next_pinned.end(), p);
  };
  if (held >= 0 && !stays(held)) return true;
  return !std::equal(pinned.begin(), pinned.end(), next_pinned.begin(), next_pinned.end()) &&
         !std::all_of(pinned.begin(), pinned.end(), stays);
}

void StepGuard::spend_budgets() {
  divergence_budget_ = tear_budget_ = 0;
  elongation_ = std::numeric_limits<double>::infinity();
}

void StepGuard::invalidate() {
  spend_budgets();
  since_backup_ = -1;
}

void StepGuard::accept_changes(const Preset& from, const Preset& to) {
  EffectSet changed = changes(from, to);
  if (changed.touches(Effect::force) && (from.W != to.W || from.u != to.u)) {
    // Wind alone, which gusts change all the time, changes no energy.
    Preset in_old_wind = to;
    in_old_wind.W = from.W, in_old_wind.u = from.u;
    changed = changes(from, in_old_wind);
  }
  energy_stale_ |= changed.touches(Effect::force), pushes_stale_ |= changed.touches(Effect::bodies);
}

int StepGuard::steps_ahead(int most, bool tears_by_itself) const {
  assert(most >= 1);
  const double motion =
      rules_.tearing && !tears_by_itself ? std::min(divergence_budget_, tear_budget_) : divergence_budget_;
  constexpr double margin = 2;  // motion does not double within a few steps, unless something is going wrong
  if (!(motion > 0) || limit_.may_be_exceeded(margin * elongation_)) return 1;
  return int(std::clamp(motion / (margin * elongation_), 1.0, double(most)));
}

bool StepGuard::overload_within(int steps) const {
  assert(steps >= 1);
  return rules_.tearing && tear_budget_ < steps * elongation_ && elongation_ < divergence_budget_;
}

BatchResult StepGuard::judge(GuardedSteps& engine, int count, Tears& tears, Fault& fault) {
  assert(count >= 1);
  for (int n = 0; n < count; ++n) {
    const StepMeasures step = engine.measures(n);
    assert(step.dt > 0 && step.left_inside >= 0);
    assert(!(step.elongation < 0) && !(step.residual < 0) && step.limited_seconds >= 0);
    limit_.pass(step.dt);
    elongation_ = std::isfinite(step.elongation) ? step.elongation : std::numeric_limits<double>::infinity();
    divergence_budget_ -= elongation_, tear_budget_ -= elongation_;
    if (step.tear_budget) tear_budget_ = *step.tear_budget;
    left_inside_ = step.left_inside;
    const bool tear = rules_.tearing && !step.tear_budget && !(tear_budget_ > 0), look = !(divergence_budget_ > 0);
    const bool fast = limit_.may_be_exceeded(elongation_, step.dt);
    const bool release = step.hand_force && rules_.F_release > 0 && glm::length(*step.hand_force) > rules_.F_release;
    if ((tear || look || fast || release) && n < count - 1) return {n + 1, BatchEnd::rolled_back};
    if (tear) tear_budget_ = engine.tear_overloaded(tears);
    const bool parts = tear && rules_.parting && !(tear_budget_ > 0) && !repeating_;
    if (look && engine.find_fault(tears, fault, divergence_budget_)) return {n, BatchEnd::fault};
    if (fast && engine.find_runaway(limit_, fault)) return {n, BatchEnd::fault};
    unconverged_steps_ += !step.converged, rounded_steps_ += step.rounded;
    worst_residual_ = std::max(worst_residual_, step.residual);
    longest_limited_ = std::max(longest_limited_, step.limited_seconds);
    hand_force_ = step.hand_force.value_or(glm::dvec3(0));
    if (release) return {n + 1, BatchEnd::released};
    if (parts) return {n + 1, BatchEnd::overloaded};
  }
  return {count, BatchEnd::complete};
}

void StepGuard::keep_backup(GuardedSteps& engine, const Tears& tears) {
  since_backup_ = -1;  // there is none if memory fails halfway
  engine.keep_backup();
  if (rules_.tearing) tears_backup_ = tears;
  limit_backup_ = limit_;
  since_backup_ = 0;
}

/// `unjudged`: how many of the last steps are still to be judged.
void StepGuard::repeat(GuardedSteps& engine, int steps, Tears& tears, int unjudged) {
  assert(since_backup_ >= 0 && unjudged >= 0 && unjudged <= steps);
  if (rules_.tearing) tears = tears_backup_;
  spend_budgets();
  limit_ = limit_backup_;
  repeating_ = true;
  try {
    engine.repeat(steps, tears);
  } catch (...) {
    repeating_ = false;
    throw;
  }
  repeating_ = false;
  spend_budgets();
  limit_ = limit_backup_;  // whether or not the engine has judged them
  for (int n = unjudged; n < steps; ++n) limit_.pass(limit_.dt());
}

void StepGuard::remeasure(GuardedSteps& engine, const Tears& tears) {
  assert(energy_stale_ || pushes_stale_);
  const Motion motion = engine.motion(tears);
  energy_stale_ ? limit_.begin(motion) : limit_.push(motion.pushed);
  energy_stale_ = pushes_stale_ = false;
}

/// Makes steps that have been overwritten again, up to the one to be examined, and examines it.
BatchResult StepGuard::examine_last(GuardedSteps& engine, int count, Tears& tears, Fault& fault) {
  repeat(engine, since_backup_ + count, tears, 1);
  const BatchResult last = judge(engine, 1, tears, fault);
  return {count - 1 + last.count, last.end};
}

AdvanceResult StepGuard::advance(GuardedSteps& engine, int steps, Tears& tears, const Stop& stop, bool once) {
  AdvanceResult result;
  const int torn_before = tears.torn_count();
  assert(steps >= 0);
  Fault fault{};
  if (energy_stale_ || pushes_stale_) remeasure(engine, tears);
  while (result.steps < steps && !result.diverged && !result.released && !result.stopped && !result.overloaded) {
    if (stop && stop()) {
      result.stopped = true;
      break;
    }
    if (since_backup_ < 0 || since_backup_ >= steps_between_backups) keep_backup(engine, tears);
    const int most = rules_.costly_steps && (stop || once)
                         ? 1
                         : std::min(steps - result.steps, steps_between_backups - since_backup_);
    BatchResult made;
    bool rolled_back = false;
    try {
      made = engine.make_steps(most, tears, fault);
      assert(made.count <= most);
      rolled_back = made.end == BatchEnd::rolled_back;
      if (rolled_back) made = examine_last(engine, made.count, tears, fault);
      assert(made.count >= 0 && made.end != BatchEnd::rolled_back);
      assert(made.end != BatchEnd::fault || made.count < most);
      assert(made.end != BatchEnd::complete || made.count > 0);  // or this would never end
    } catch (const std::bad_alloc&) {
      // Back to the last step that counts. It has been made before, so this asks for no memory that was not there.
      repeat(engine, since_backup_, tears, 0);
      since_backup_ = -1, torn_ = tears.torn_count();
      if (result.steps == 0) throw;
      break;  // who asks for more steps is told then
    }
    result.diverged = made.end == BatchEnd::fault;
    result.released = made.end == BatchEnd::released;
    result.overloaded = made.end == BatchEnd::overloaded;
    result.stopped = made.end == BatchEnd::stopped;
    result.steps += made.count;
    if (result.diverged || (result.stopped && rules_.costly_steps))
      repeat(engine, since_backup_ + made.count, tears, 0);
    // After a fault nothing is known of the next step; what has just been repeated must not be repeated again.
    since_backup_ = result.diverged || rolled_back || rules_.costly_steps ? -1 : since_backup_ + made.count;
    torn_ = tears.torn_count();
  }
  assert(result.steps <= steps);
  result.i = fault.i, result.j = fault.j, result.di = fault.di, result.dj = fault.dj, result.value = fault.value;
  if (result.diverged) result.quantity = fault.quantity, result.excess = fault.excess;
  result.torn = tears.torn_count() - torn_before;
  assert(result.torn >= 0);
  result.left_inside = left_inside_;
  result.hand_force = hand_force_;
  return result;
}

}  // namespace tyglab
