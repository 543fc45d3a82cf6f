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

/// Dt of the coarser of two references, s: what moves slowly is followed closely anyway.
double coarser_reference_dt(const Preset& preset, double finer) {
  constexpr double slowest = 0.016;  // in place of the stable dt
  return std::clamp(std::min(stable_dt(preset, "verlet"), slowest) / finer, least_dt, slowest);
}

/// `followed`: told the part of the way, 0 to 1, a hundred times on it.
Track follow(const StudyStart& start, const Preset& preset, int steps, const Stop& stop,
             const std::function<void(double)>& followed = {}) {
  const int piece = std::max(1, steps * accuracy_samples / 100);
  const auto of = begin_study(start, preset);
  Simulation& simulation = *of;
  Track track;
  for (int n = 0; n < accuracy_samples; ++n) {
    for (int done = 0; done < steps; done += piece) {
      advance_study(simulation, std::min(piece, steps - done), stop);
      if (simulation.divergence()) throw std::runtime_error("the motion diverged: " + simulation.divergence()->cause);
      if (followed) followed((n + std::min(1.0, double(done + piece) / steps)) / accuracy_samples);
    }
    track.push_back(positions_of(simulation));
  }
  return track;
}

}  // namespace

double StudyReference::error_of(const Track& other) const {
  if (over == ErrorOver::all_times) return rms_distance(other, track);
  double worst = 0;
  for (std::size_t n = 0; n < track.size(); ++n) worst = std::max(worst, rms_distance({other[n]}, {track[n]}));
  return worst;
}

double reference_effort(const Preset& preset, double seconds, double finer) {
  Preset with = preset;
  with.integrator = reference_method(preset);
  return 3 * step_effort(with) * seconds /
         coarser_reference_dt(preset, finer);  // two runs, the second of twice the steps
}

StudyReference reference_over(const StudyStart& start, double seconds, double finer, ErrorOver over, const Stop& stop,
                              const ReferenceProgress& progress) {
  Preset preset = start.preset;
  preset.precision = Precision::double_, preset.integrator = reference_method(preset);
  StudyReference reference{.seconds = seconds, .track = {}, .method = preset.integrator, .over = over};
  int steps = 0;
  preset.dt = whole_dt(seconds, coarser_reference_dt(preset, finer), steps);
  // Two runs, the second of twice the steps.
  const auto done = [&](double before, double share) {
    return [=, &progress](double part) {
      if (progress) progress(seconds, before + share * part);
    };
  };
  if (progress) progress(seconds, 0);
  const Track coarser = follow(start, preset, steps, stop, done(0, 1.0 / 3));
  reference.dt = preset.dt = preset.dt / 2;
  reference.track = follow(start, preset, 2 * steps, stop, done(1.0 / 3, 2.0 / 3));
  reference.agreement_rms_m = reference.error_of(coarser);
  return reference;
}

void check_by_another_method(const StudyStart& start, StudyReference& reference, const Stop& stop,
                             const ReferenceProgress& progress) {
  Preset preset = start.preset;
  preset.precision = Precision::double_;
  // Runge-Kutta evaluates the forces four times in a step: with twice the dt it takes as long as both references.
  const bool cheap = reference.method == "velocity_verlet";
  preset.integrator = cheap ? "rk4" : "velocity_verlet";
  int steps = 0;
  preset.dt = whole_dt(reference.seconds, cheap ? 2 * reference.dt : reference.dt / 2, steps);
  const Track other = follow(start, preset, steps, stop, [&](double part) {
    if (progress) progress(reference.seconds, part);
  });
  reference.agreement_rms_m = std::max(reference.agreement_rms_m, reference.error_of(other));
}

StudyReference study_reference(const StudyStart& start, double seconds, const StudyEffort& effort, const Stop& stop,
                               const ReferenceProgress& progress) {
  constexpr double finer = 16;  // than the coarsest stable dt of Verlet
  const Preset& preset = start.preset;
  seconds = std::min(seconds, effort.reference / reference_effort(preset, 1, finer));
  // Comparing where the present dt ends its steps checks the settings as they are.
  constexpr double patience = 4;  // times the effort, for a long dt
  const double whole = accuracy_samples * preset.dt;
  if (whole <= patience * seconds) {
    seconds = whole * std::max(1.0, std::floor(seconds / whole));
  } else {
    seconds = std::max(seconds, accuracy_samples * coarser_reference_dt(preset, finer));
  }
  return reference_over(start, seconds, finer, ErrorOver::all_times, stop, progress);
}

namespace {

/// Asks `stop`, and now and then the clock: a step of a small cloth is quicker than a look at it.
class TimeLimit {
 public:
  TimeLimit(const Stop& stop, double most) : stop_(stop), most_(most), begun_(thread_seconds()) {}
  bool reached() {
    if (stop_()) return true;
    if (!over_ && ++asked_ % 32 == 0) over_ = thread_seconds() - begun_ > most_;
    return over_;
  }
  bool over() const { return over_; }

 private:
  const Stop& stop_;
  double most_, begun_;
  int asked_ = 0;
  bool over_ = false;
};

}  // namespace

ErrorPoint measure_point(const StudyStart& start, const StudyReference& reference, const Stop& stop, double most) {
  constexpr double short_run = 0.02;  // s: repeated, and the least time taken
  Preset preset = start.preset;
  const bool chooses = chooses_steps(scheme(preset.integrator));
  int steps = 1;
  preset.dt = whole_dt(reference.seconds, chooses ? reference.seconds : preset.dt, steps);
  ErrorPoint point{preset.integrator, preset.precision, preset.dt, chooses ? preset.tolerance : 0};
  double took = std::numeric_limits<double>::infinity();
  for (int run = 0; run < (took < short_run ? 3 : 1) && !point.given_up; ++run) {
    const auto of = begin_study(start, preset);
    Simulation& simulation = *of;
    Track track;
    double now = 0;
    TimeLimit limit(stop, most);
    for (int n = 0; n < accuracy_samples && !simulation.divergence() && !point.given_up; ++n) {
      const double before = thread_seconds();
      try {
        advance_study(simulation, steps, [&] { return limit.reached(); });
      } catch (const Stopped&) {
        if (!limit.over()) throw;
        point.given_up = true;
      }
      now += thread_seconds() - before;
      track.push_back(positions_of(simulation));
    }
    took = std::min(took, now);
    // What a fixed number of passes leaves is part of such a method's error.
    point.converged = counts_passes(scheme(preset.integrator)) || simulation.engine().solves().unconverged == 0;
    if (chooses) {
      const auto inner = std::max<std::int64_t>(1, simulation.engine().inner_steps().accepted);
      point.dt = reference.seconds / double(inner);
    }
    const bool whole = !simulation.divergence() && !point.given_up;
    // Between the times of comparison a blow may have left more than is seen at them.
    point.error_rms_m = whole ? std::max(reference.error_of(track), reference.blow * point.dt)
                              : std::numeric_limits<double>::infinity();
    if (!whole) break;
  }
  point.cost = took / reference.seconds;
  point.resolved = point.error_rms_m >= reference_margin * reference.agreement_rms_m;
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
  constexpr double unlimited = 0.1;  // s: what methods without a limit begin with
  if (chooses_steps(scheme(preset.integrator))) {
    preset.tolerance = 1e-2;
    return true;
  }
  const double stable = has_step_limit(scheme(preset.integrator)) ? advised_dt(preset, preset.integrator) : unlimited;
  preset.dt = std::min({stable, unlimited, seconds / accuracy_samples, longest_dt});
  return preset.dt >= least_dt;
}

}  // namespace

std::vector<ErrorPoint> error_ladder(StudyStart start, const StudyReference& reference, const StudyEffort& effort,
                                     const Stop& stop, const std::function<bool(std::span<const ErrorPoint>)>& enough) {
  std::vector<ErrorPoint> points;
  Preset& preset = start.preset;
  if (!coarsest(preset, reference.seconds)) return points;
  const Scheme& method = scheme(preset.integrator);
  const double a_step = step_effort(preset);
  // Half the dt costs an explicit method twice as much; an implicit one solves shorter steps in fewer iterations.
  int patience = is_implicit(method) ? 3 : 1, no_better = 0;
  double best = std::numeric_limits<double>::infinity();
  do {
    if (!chooses_steps(method) && a_step * reference.seconds / preset.dt > effort.point) break;
    points.push_back(measure_point(start, reference, stop, effort.cost * reference.seconds));
    const ErrorPoint& point = points.back();
    if (enough(points)) break;
    if (std::isfinite(point.error_rms_m)) no_better = point.error_rms_m < 0.9 * best ? 0 : no_better + 1;
    best = std::min(best, point.error_rms_m);
    const bool dear =
        point.given_up || point.cost > effort.cost || point.cost * reference.seconds * 1e9 / 4 > effort.point;
    if (no_better == 3 || (dear && --patience == 0)) break;
  } while (refine(preset));
  return points;
}

std::vector<ErrorPoint> error_ladder(StudyStart start, const StudyReference& reference, double enough,
                                     const StudyEffort& effort, const Stop& stop) {
  return error_ladder(std::move(start), reference, effort, stop, [enough](std::span<const ErrorPoint> points) {
    return points.back().error_rms_m <= enough || !points.back().resolved;
  });
}

}  // namespace tyglab
