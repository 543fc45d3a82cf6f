#include "core/analysis/tolerance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/energy/auto_step.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/model/readable.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

/// Every other method has one beside it here that is better at the same cost: Verlet is the cheapest of the first two
/// orders, XPBD's error does not fall with dt alone.
constexpr std::array candidates{"verlet", "velocity_verlet", "rk4", "rkn4", "dopri5", "implicit_midpoint"};
constexpr double aim = 0.5;       // of the tolerance: the trial is short
constexpr double longest = 1;     // s of motion in a trial
constexpr int shorter_tries = 5;  // halvings of it, where it cannot be checked so long

std::string number(double value) {
  return short_number(value, 2);
}

/// The reference over as much of the motion as can be distinguished from a tenth of the tolerance.
StudyReference judge(const StudyStart& start, double tolerance, double seconds, const Stop& stop) {
  seconds = std::min(seconds, longest);
  StudyReference reference;
  for (int n = 0; n < shorter_tries; ++n, seconds /= 2) {
    reference = study_reference(start, seconds, {}, stop);
    if (10 * reference.agreement_rms_m <= tolerance) return reference;
  }
  throw ToleranceError(
      "this motion cannot be predicted to " + number(tolerance) + " m: over its first " + number(reference.seconds) +
      " s two fine runs (" + reference.method + ", dt = " + number(2 * reference.dt) + " s and half of it) differ by " +
      number(reference.agreement_rms_m) + " m. Use " + number(20 * reference.agreement_rms_m) + " or more.");
}

struct Found {
  Preset preset;
  ErrorPoint point;
};

/// The coarsest setting of a method that reaches the error, if any; `least` becomes the least error seen.
std::optional<Found> find(StudyStart start, const StudyReference& reference, double enough, const StudyEffort& effort,
                          ErrorPoint& least, const Stop& stop) {
  for (const ErrorPoint& point : error_ladder(start, reference, enough, effort, stop)) {
    if (point.error_rms_m < least.error_rms_m) least = point;
    if (!(point.error_rms_m <= enough)) continue;
    Found found{start.preset, point};
    if (point.tolerance > 0) {
      found.preset.tolerance = point.tolerance;
    } else {
      found.preset.dt = std::max(two_digits_below(point.dt), 1e-7);  // at most what was measured
    }
    return found;
  }
  return std::nullopt;
}

std::string settings_of(const ErrorPoint& point) {
  const std::string step =
      point.tolerance > 0 ? "tolerance = " + number(point.tolerance) + " m" : "dt = " + number(point.dt) + " s";
  return point.integrator + ", " + step + ", " + std::string(name_of(point.precision));
}

}  // namespace

std::string ToleranceChoice::words(double tolerance) const {
  ErrorPoint used = chosen;
  if (used.tolerance == 0) used.dt = preset.dt;
  std::string text = settings_of(used) + ": error " + (chosen.resolved ? "" : "below ") +
                     number(chosen.resolved ? chosen.error_rms_m : std::max(chosen.error_rms_m, 10 * agreement_rms_m)) +
                     " m (rms) over the first " + number(seconds) + " s, where " + number(tolerance) +
                     " m were requested; it takes " + number(chosen.cost) + " s of CPU time per simulated second.";
  if (reached.size() > 1)
    text += " The next best is " + settings_of(reached[1]) + " with " + number(reached[1].cost / chosen.cost) +
            " times that.";
  return text + " Errors grow with time, so later results may be less accurate.";
}

ToleranceChoice choose_for_tolerance(const Preset& preset, double tolerance, double seconds,
                                     const ToleranceKeeps& keeps, const Stop& stop) {
  StudyStart start{preset, std::nullopt};
  const StudyReference reference = judge(start, tolerance, seconds, stop);
  std::vector<std::string> methods(candidates.begin(), candidates.end());
  if (keeps.integrator) methods = {preset.integrator};
  if (preset.engine == EngineKind::opencl)
    std::erase_if(methods, [](const std::string& name) { return !runs_on_opencl(scheme(name)); });
  ErrorPoint least;
  least.error_rms_m = std::numeric_limits<double>::infinity();
  std::vector<Found> found;
  const auto try_all = [&](Precision precision) {
    for (const std::string& method : methods) {
      start.preset = preset;
      start.preset.integrator = method, start.preset.precision = precision;
      // Who is already twice as dear as the cheapest will not be cheaper with a finer dt.
      StudyEffort effort;
      for (const Found& one : found) effort.cost = std::min(effort.cost, 2 * one.point.cost);
      if (auto one = find(start, reference, aim * tolerance, effort, least, stop)) found.push_back(std::move(*one));
    }
  };
  try_all(preset.precision);
  if (found.empty() && !keeps.precision && preset.precision == Precision::float_) try_all(Precision::double_);
  if (found.empty())
    throw ToleranceError(
        "no method reaches " + number(tolerance) + " m here with a margin of two" +
        (std::isfinite(least.error_rms_m)
             ? "; the best was " + settings_of(least) + " with " + number(least.error_rms_m) + " m"
             : "") +
        ". Use a larger tolerance" + (keeps.integrator ? " or leave the method open" : "") +
        (keeps.precision && preset.precision == Precision::float_ ? " or leave the precision open" : "") + ".");
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.point.cost < b.point.cost; });
  ToleranceChoice choice{found.front().preset, found.front().point, {}, reference.seconds, reference.agreement_rms_m};
  for (const Found& one : found) choice.reached.push_back(one.point);
  return choice;
}

}  // namespace tyglab
