#include "core/engines/newton.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace tyglab {
namespace {

constexpr double flat_enough = 0.2;  // slope along a step where it ends, of that at its beginning
constexpr int most_tries = 20;

/// Finds the step; directly where conjugate gradients do not get there, and from then on in this stage. Where that,
/// too, is not possible, the step is what conjugate gradients have left.
void find_step(ImplicitStage& stage, bool& direct) {
  if (direct && stage.solve_directly()) return;
  if (stage.gradients() || stage.stops() || stage.out_of_time()) return;
  direct = !direct && stage.solve_directly();
}

/// Goes along the step, or less far where that overshoots; returns |r| there.
double take_step(ImplicitStage& stage, double slope, SolveCounts& counts) {
  // The residual is minus the slope of the potential that a solution makes least; the system is positive, so `slope` is
  // > 0. Along the step the potential is convex, its slope thus rises: where the step overshoots, the least value lies
  // between 0 and its end. False position, in the form that halves the slope of an end that stays (Illinois).
  double part = 1, lower = 0, lower_slope = slope, upper = 0, upper_slope = 0;
  ImplicitStage::Trial now{};
  for (int tries = 0; tries <= most_tries; ++tries) {
    now = stage.try_part(part);
    if (stage.stops()) break;
    ++counts.force_evaluations;
    if (std::abs(now.slope) <= flat_enough * slope || (now.slope > 0 && part == 1)) break;
    if (!(now.slope > 0)) {  // beyond it, or not finite
      if (upper != 0) lower_slope /= 2;
      upper = part, upper_slope = std::isfinite(now.slope) ? now.slope : -std::numeric_limits<double>::max();
    } else {
      if (lower != 0) upper_slope /= 2;
      lower = part, lower_slope = now.slope;
    }
    assert(!(lower > upper));  // what is between them is halved or so in each try
    const double secant = lower + (upper - lower) * lower_slope / (lower_slope - upper_slope);
    part = std::clamp(secant, lower + 0.01 * (upper - lower), lower + 0.9 * (upper - lower));
  }
  return now.residual;
}

/// The solution of a single linear system is taken as it is; |r| there says how good it is.
double take_whole_step(ImplicitStage& stage, SolveCounts& counts) {
  ++counts.force_evaluations;
  return stage.try_part(1).residual;
}

}  // namespace

Balance solve(ImplicitStage& stage, const NewtonRules& rules, SolveCounts& counts) {
  assert(rules.most >= 1 && rules.tolerance > 0 && rules.epsilon > 0 && rules.h > 0);
  const double first = stage.evaluate();
  ++counts.force_evaluations;
  const double last_digits = 4 * rules.epsilon * stage.start_size();
  bool direct = false;  // every stage tries again: a repeated step must give the same bits
  bool ended = first <= rules.enough;
  double norm = first;
  for (int n = 0; n < rules.most && !ended && std::isfinite(norm) && (n == 0 || !stage.out_of_time()); ++n) {
    stage.begin_iteration(n, rules.most);
    stage.linearize();
    find_step(stage, direct);
    if (stage.stops()) return {};
    ++counts.newton;
    const ImplicitStage::Step step = stage.step();
    const double before = norm;
    norm = rules.most == 1 ? take_whole_step(stage, counts) : take_step(stage, step.slope, counts);
    // Velocities have more digits than the positions that they lead to: the residual may still fall.
    const bool still = rules.h * step.size <= last_digits && norm > 0.5 * before;
    ended = norm <= std::max(rules.tolerance * first, rules.enough) || still;
  }
  return stage.balance();
}

}  // namespace tyglab
