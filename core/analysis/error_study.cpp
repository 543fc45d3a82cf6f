#include "core/analysis/error_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "core/analysis/accuracy.h"
#include "core/analysis/study_run.h"
#include "core/integrators/scheme.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

constexpr double longest_dt = 1;

/// Contact leaves no method more than its first order, so there the cheapest is refined.
std::string reference_method(const Preset& preset) {
  if (!preset.bodies.empty()) return "velocity_verlet";
  return preset.k_d > 0 ? "rk4" : "rkn4";
}

Track follow(const StudyStart& start, const Preset& preset, int steps, const Stop& stop) {
  const auto of = begin_study(start, preset);
  Simulation& simulation = *of;
  Track track;
  for (int n = 0; n < accuracy_samples; ++n) {
    advance_study(simulation, steps, stop);
    if (simulation.divergence()) throw std::runtime_error("the motion diverged: " + simulation.divergence()->cause);
    track.push_back(positions_of(simulation));
  }
  return track;
}

}  // namespace

StudyReference study_reference(const StudyStart& start, double seconds, const StudyEffort& effort, const Stop& stop) {
  constexpr double finer = 16;       // than the coarsest stable dt of Verlet
  constexpr double longest = 0.001;  // s: what moves slowly is followed closely anyway
  Preset preset = start.preset;
  preset.precision = Precision::double_, preset.integrator = reference_method(preset);
  const double coarse = std::clamp(stable_dt(preset, "verlet") / finer, least_dt, longest);
  // Two runs, the second of twice the steps.
  const double a_second = 3 * step_effort(preset) / coarse;
  seconds = std::min(seconds, effort.reference / a_second);
  // Comparing where the present dt ends its steps checks the settings as they are.
  constexpr double patience = 4;  // times the effort, for a long dt
  const double whole = accuracy_samples * start.preset.dt;
  if (whole <= patience * seconds) {
    seconds = whole * std::max(1.0, std::floor(seconds / whole));
  } else {
    seconds = std::max(seconds, accuracy_samples * coarse);
  }
  StudyReference reference{.seconds = seconds, .track = {}, .method = preset.integrator};
  int steps = 0;
  preset.dt = whole_dt(seconds, coarse, steps);
  const Track coarser = follow(start, preset, steps, stop);
  reference.dt = preset.dt = preset.dt / 2;
  reference.track = follow(start, preset, 2 * steps, stop);
  reference.agreement_rms_m = rms_distance(reference.track, coarser);
  return reference;
}

ErrorPoint measure_point(const StudyStart& start, const StudyReference& reference, const Stop& stop) {
  constexpr double short_run = 0.02;  // s: repeated, and the least time taken
  Preset preset = start.preset;
  const bool chooses = chooses_steps(scheme(preset.integrator));
  int steps = 1;
  preset.dt = whole_dt(reference.seconds, chooses ? reference.seconds : preset.dt, steps);
  ErrorPoint point{preset.integrator, preset.precision, preset.dt, chooses ? preset.tolerance : 0};
  double took = std::numeric_limits<double>::infinity();
  for (int run = 0; run < (took < short_run ? 3 : 1); ++run) {
    const auto of = begin_study(start, preset);
    Simulation& simulation = *of;
    Track track;
    double now = 0;
    for (int n = 0; n < accuracy_samples && !simulation.divergence(); ++n) {
      const double before = thread_seconds();
      advance_study(simulation, steps, stop);
      now += thread_seconds() - before;
      track.push_back(positions_of(simulation));
    }
    took = std::min(took, now);
    if (chooses) {
      const auto inner = std::max<std::int64_t>(1, simulation.engine().inner_steps().accepted);
      point.dt = reference.seconds / double(inner);
    }
    point.error_rms_m =
        simulation.divergence() ? std::numeric_limits<double>::infinity() : rms_distance(track, reference.track);
    if (simulation.divergence()) break;
  }
  point.cost = took / reference.seconds;
  point.resolved = point.error_rms_m >= 10 * reference.agreement_rms_m;
  return point;
}

namespace {

/// The next finer setting of the method; false where there is none.
bool refine(Preset& preset) {
  if (chooses_steps(scheme(preset.integrator))) {
    preset.tolerance /= 10;
    return preset.tolerance > (preset.precision == Precision::float_ ? 0.9e-6 : 0.9e-12);
  }
  preset.dt /= 2;
  return preset.dt >= least_dt;
}

/// The coarsest setting worth trying; false where the method has no stable one.
bool coarsest(Preset& preset, double seconds) {
  constexpr double frame = 0.03;  // s: what methods without a limit begin with
  if (chooses_steps(scheme(preset.integrator))) {
    preset.tolerance = 1e-2;
    return true;
  }
  const double stable = has_step_limit(scheme(preset.integrator)) ? advised_dt(preset, preset.integrator) : frame;
  preset.dt = std::min({stable, frame, seconds / accuracy_samples, longest_dt});
  return preset.dt >= least_dt;
}

}  // namespace

std::vector<ErrorPoint> error_ladder(StudyStart start, const StudyReference& reference, double enough,
                                     const StudyEffort& effort, const Stop& stop) {
  std::vector<ErrorPoint> points;
  Preset& preset = start.preset;
  if (!coarsest(preset, reference.seconds)) return points;
  const double a_step = step_effort(preset);
  int no_better = 0;
  double best = std::numeric_limits<double>::infinity();
  do {
    if (!chooses_steps(scheme(preset.integrator)) && a_step * reference.seconds / preset.dt > effort.point) break;
    points.push_back(measure_point(start, reference, stop));
    const ErrorPoint& point = points.back();
    if (point.error_rms_m <= enough || !point.resolved) break;
    if (std::isfinite(point.error_rms_m)) no_better = point.error_rms_m < 0.9 * best ? 0 : no_better + 1;
    best = std::min(best, point.error_rms_m);
    if (no_better == 3 || point.cost * reference.seconds * 1e9 / 4 > effort.point || point.cost > effort.cost) break;
  } while (refine(preset));
  return points;
}

}  // namespace tyglab
