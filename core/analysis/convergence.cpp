#include "core/analysis/convergence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analysis/study_run.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"

namespace tyglab {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double as_promised = 0.25;  // how far a measured order may be from the nominal one to count as the same

/// The motion with one dt: positions at the times of comparison, none of them once it has diverged.
struct Run {
  Track track;
  int torn = 0;
};

Run run(const StudyStart& start, const Preset& preset, int steps, const Stop& stop) {
  const auto of = begin_study(start, preset);
  const int before = of->tears().torn_count();
  Run result;
  for (int n = 0; n < accuracy_samples; ++n) {
    advance_study(*of, steps, stop);
    if (of->divergence()) return {};
    result.track.push_back(positions_of(*of));
  }
  result.torn = of->tears().torn_count() - before;
  return result;
}

/// Slope of the logarithms by least squares.
double slope(std::span<const std::pair<double, double>> points) {
  double x_mean = 0, y_mean = 0, xy = 0, xx = 0;
  for (const auto& [x, y] : points)
    x_mean += std::log(x) / double(points.size()), y_mean += std::log(y) / double(points.size());
  for (const auto& [x, y] : points) {
    xy += (std::log(x) - x_mean) * (std::log(y) - y_mean);
    xx += (std::log(x) - x_mean) * (std::log(x) - x_mean);
  }
  return xy / xx;
}

/// What can keep a method from its order in this scene.
std::string why_lower(const Convergence& study) {
  const Preset& preset = study.of;
  if (study.torn > 0)
    return printed("%d springs tore, each at the end of a step, which reduces the order to 1.", study.torn);
  if (!preset.bodies.empty() && preset.contact == "step")
    return "Contact with bodies begins in the middle of a step, which reduces the order to 1.";
  if (!preset.bodies.empty() && preset.contact == "global")
    return "Impacts split steps, but resting and sliding are computed with second order.";
  if (!preset.bodies.empty())
    return preset.k_d > 0
               ? "Damping passes an impact on to other particles from the next step on, which reduces the order to 1."
               : "Each impact is found within its step, with an error of second order.";
  if (preset.kind == Kind::cloth)
    return "Springs that tighten and slacken put kinks in the forces, which lower the order.";
  return "A smaller dt may come closer to it.";
}

/// The coarsest runs, where they diverged.
std::string diverged_words(const Convergence& study) {
  double finest = 0;
  int count = 0;
  for (const ConvergencePoint& point : study.points)
    if (!std::isfinite(point.error_rms_m)) finest = point.dt, ++count;
  if (count == 0) return {};
  return "With dt = " + short_number(finest, 3) + " s" + (count > 1 ? " or more" : "") + " it diverges. ";
}

}  // namespace

int nominal_order(const Preset& preset) {
  const Scheme& method = scheme(preset.integrator);
  return preset.k_d > 0 ? method.order_damped : method.order_undamped;
}

bool by_reference(const Convergence& study) {
  const auto resolved = std::count_if(study.points.begin(), study.points.end(), [](const ConvergencePoint& point) {
    return point.resolved && std::isfinite(point.error_rms_m) && point.error_rms_m > 0;
  });
  const bool others = std::any_of(study.points.begin(), study.points.end(),
                                  [](const ConvergencePoint& point) { return point.difference_rms_m > 0; });
  return study.referenced && (resolved >= 2 || !others);
}

std::optional<double> shown_error(const Convergence& study, const ConvergencePoint& point) {
  const bool reference = by_reference(study);
  const double error = reference ? point.error_rms_m : point.difference_rms_m;
  if (!std::isfinite(error) || error <= 0 || (reference && !point.resolved)) return std::nullopt;
  return error;
}

std::optional<MeasuredOrder> measured_order(const Convergence& study) {
  constexpr std::size_t most = 4;
  std::vector<std::pair<double, double>> points;
  for (const ConvergencePoint& point : study.points)
    if (const auto error = shown_error(study, point)) points.emplace_back(point.dt, *error);
  if (points.size() < 2) return std::nullopt;
  if (points.size() > most) points.erase(points.begin(), points.end() - most);
  return MeasuredOrder{slope(points), points.front().first, points.back().first, !by_reference(study)};
}

std::string convergence_words(const Convergence& study) {
  if (!study.problem.empty()) return "The order cannot be measured: " + study.problem;
  const auto order = measured_order(study);
  const int nominal = nominal_order(study.of);
  const std::string method(scheme(study.of.integrator).title);
  std::string words = diverged_words(study);
  if (!order)
    return words +
           (words.empty()
                ? "The error is less than ten times that of the reference, so it cannot be measured. Use a larger dt."
                : "Use a smaller dt.");
  words += printed("Measured order %.2f", order->order);
  if (order->by_differences) words += " from differences between runs, since no reference is accurate enough";
  words += printed("; %s has %d for smooth motion. ", method.c_str(), nominal);
  if (order->order < nominal - as_promised) words += why_lower(study) + " ";
  if (order->order > nominal + as_promised) words += "The largest values of dt are too large for a clean slope. ";
  const auto hidden =
      std::find_if(study.points.begin(), study.points.end(), [](const auto& point) { return !point.resolved; });
  if (!order->by_differences && hidden != study.points.end())
    words += "From dt = " + short_number(hidden->dt, 3) +
             " s down the error is less than ten times that of the reference, " +
             short_number(study.reference.agreement_rms_m, 2) + " m. ";
  words.pop_back();
  return words;
}

void measure_convergence(const StudyStart& start, double seconds, const StudyEffort& effort, const Stop& stop,
                         const std::function<void(const Convergence&)>& found) {
  Convergence study;
  study.of = start.preset, study.t = start.from ? start.from->t : 0, study.seconds = seconds;
  const auto end = [&](std::string problem = {}) {
    study.problem = std::move(problem), study.done = true;
    found(study);
  };
  if (chooses_steps(scheme(start.preset.integrator)))
    return end(std::string(scheme(start.preset.integrator).title) +
               " chooses its own steps: its error follows the tolerance, not dt.");
  Track exact;
  try {
    study.reference = study_reference(start, seconds, effort, stop);
    study.seconds = study.reference.seconds, study.referenced = true;
    exact.swap(study.reference.track);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    study.seconds =
        accuracy_samples * start.preset.dt * std::max(1.0, std::floor(seconds / (accuracy_samples * start.preset.dt)));
  }
  found(study);
  Preset preset = start.preset;
  preset.precision = Precision::double_;
  int steps = 1;
  preset.dt = whole_dt(study.seconds, start.preset.dt, steps);
  Track coarser;
  for (int level = 0; level < convergence_levels; ++level, steps *= 2, preset.dt /= 2) {
    Run now = run(start, preset, steps, stop);
    ConvergencePoint point{.dt = preset.dt};
    if (now.track.empty()) {
      point.error_rms_m = infinite;
    } else if (study.referenced) {
      point.error_rms_m = rms_distance(now.track, exact);
      point.resolved = point.error_rms_m >= reference_margin * study.reference.agreement_rms_m;
    }
    if (!coarser.empty() && !now.track.empty()) study.points.back().difference_rms_m = rms_distance(coarser, now.track);
    study.points.push_back(point);
    study.torn = now.torn;
    coarser = std::move(now.track);
    found(study);
  }
  end();
}

std::string convergence_csv(const Convergence& study) {
  std::string text = "# tyglab convergence, " + study.of.integrator + " in double, " +
                     printed("t = %.9g s, over %.9g s, ", study.t, study.seconds) + "preset hash " +
                     preset_hash(study.of) + "\ndt [s],error [m],difference to dt/2 [m],status\n";
  for (const ConvergencePoint& point : study.points) {
    const bool diverged = !std::isfinite(point.error_rms_m);
    append_number(text, point.dt, 9);
    text += ',';
    if (study.referenced) append_number(text, point.error_rms_m, 9);
    text += ',';
    if (point.difference_rms_m >= 0) append_number(text, point.difference_rms_m, 9);
    text += diverged ? ",diverged\n" : point.resolved ? ",ok\n" : ",below_floor\n";
  }
  return text;
}

}  // namespace tyglab
