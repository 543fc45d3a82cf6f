#include "core/analysis/settings_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/analysis/accuracy.h"
#include "core/analysis/study_run.h"
#include "core/energy/auto_step.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/model/notation.h"
#include "core/theory/modes.h"

namespace tyglab {
namespace {

using Found = std::function<void(const SettingsSearch&)>;

/// Every other method has one beside it here that is better at the same cost: Verlet is the cheapest of the first two
/// orders, XPBD's error does not fall with dt alone. What is quick comes first, so that the rest need not go beyond it.
constexpr std::array candidates{"verlet", "velocity_verlet", "rk4",     "force_gradient4",
                                "dopri5", "implicit_euler",  "tr_bdf2", "implicit_midpoint"};
/// Likewise where damping decides over stability.
constexpr std::array for_heavy_damping{"rkc2", "damped_verlet"};
constexpr double aim = 0.5;            // of the tolerance
constexpr double most_effort = 3e9;    // particles times force evaluations of a reference: some ten seconds
constexpr double search_patience = 8;  // s of processor time for all settings

std::string two_digits(double value) {
  return short_number(value, 2);
}

bool is_rough(const Preset& preset) {
  return !preset.bodies.empty() || preset.F_max > 0;
}

/// How finely, and how long, the motion is followed: all of it, unless that takes too long and nothing new is missed.
struct Window {
  double seconds, finer;
};

Window window_of(const StudyStart& start, double seconds, const Stop& stop) {
  // The reference of a small scene costs little, however fine.
  constexpr double little_effort = 5e7, usual_effort = 1e9, finest = 64, fine = 16, coarse = 2;
  const Preset& preset = start.preset;
  const auto effort = [&](double finer) {
    return reference_effort(preset, seconds, finer) * (is_rough(preset) ? 2 : 1);
  };
  double finer = finest;
  while (finer > coarse && effort(finer) > (finer > fine ? little_effort : usual_effort)) finer /= 2;
  if (effort(finer) <= most_effort) return {seconds, finer};
  const double fits = seconds * most_effort / effort(finer);
  if (last_event_effort(preset, seconds) <= most_effort && time_of_last_event(start, seconds, stop) < fits)
    return {fits, finer};
  throw std::runtime_error("this cloth is too large or too stiff for a fine run over the " + two_digits(seconds) +
                           " s that it must cover. Use fewer rows and columns, or --dt auto");
}

StudyReference find_reference(const StudyStart& start, SettingsSearch& search, const Stop& stop, const Found& found) {
  const Window window = window_of(start, search.goal.seconds, stop);
  // The check by another method takes as long as the reference.
  const double share = search.rough ? 0.5 : 1;
  const auto from = [&](double before) {
    return [&, before](double, double part) {
      search.reference_part = before + share * part;
      found(search);
    };
  };
  StudyReference reference = reference_over(start, window.seconds, window.finer, ErrorOver::worst_time, stop, from(0));
  if (search.rough) check_by_another_method(start, reference, stop, from(share));
  reference.blow = hardest_blow(start, window.seconds, stop);
  search.seconds = reference.seconds, search.agreement_rms_m = reference.agreement_rms_m;
  search.references = std::string(search.rough ? "velocity_verlet and rk4" : reference.method) +
                      ", dt = " + two_digits(reference.dt) + " s or more";
  return reference;
}

bool usable(const ErrorPoint& point) {
  return std::isfinite(point.error_rms_m) && point.converged && !point.given_up;
}

/// Whether both are settings of the same method.
bool same_method(const ErrorPoint& a, const ErrorPoint& b) {
  return a.integrator == b.integrator && a.precision == b.precision;
}

/// The settings of one method after the other.
std::vector<std::span<const ErrorPoint>> grouped_by_method(std::span<const ErrorPoint> points) {
  std::vector<std::span<const ErrorPoint>> methods;
  for (std::size_t first = 0, n = 1; n <= points.size(); ++n)
    if (n == points.size() || !same_method(points[first], points[n]))
      methods.push_back(points.subspan(first, n - first)), first = n;
  return methods;
}

/// The error that each setting of a method can be relied on for: of rough motions the largest of it and all finer ones,
/// which a finer one must confirm.
std::vector<double> reliable_errors(std::span<const ErrorPoint> points, bool rough) {
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> errors(points.size(), none);
  double largest = 0;
  bool confirmed = !rough;
  for (std::size_t n = points.size(); n-- > 0;) {
    if (!usable(points[n])) continue;
    const double error = points[n].error_rms_m;
    largest = rough ? std::max(largest, error) : error;
    if (confirmed) errors[n] = largest;
    confirmed = true;
  }
  return errors;
}

/// The cheapest of a method's settings that reach the error; null where none does.
const ErrorPoint* cheapest(std::span<const ErrorPoint> points, bool rough, double error) {
  const std::vector<double> errors = reliable_errors(points, rough);
  const ErrorPoint* best = nullptr;
  for (std::size_t n = 0; n < points.size(); ++n)
    if (errors[n] <= error && (best == nullptr || points[n].cost < best->cost)) best = &points[n];
  return best;
}

/// Measures settings of one method after the other.
class Searcher {
 public:
  Searcher(const StudyStart& start, const StudyReference& reference, SettingsSearch& search, const Stop& stop)
      : start_(start), reference_(reference), search_(search), stop_(stop) {
    enough_ = aim * std::max(search.goal.tolerance, search.margin() * reference.agreement_rms_m);
    effort_.point = std::max(effort_.point, reference_effort(start.preset, reference.seconds, 16) / 2);
  }

  /// The cheapest that was found, processor seconds for a simulated second; infinite before any was.
  double best_cost() const { return best_; }
  bool out_of_time() const { return thread_seconds() - begun_ > search_patience; }

  void try_method(const std::string& integrator, Precision precision) {
    StudyStart start = start_;
    start.preset.integrator = integrator, start.preset.precision = precision;
    const double left = std::max(0.1, search_patience - (thread_seconds() - begun_));
    // Who is already twice as dear as the cheapest will not be cheaper with a finer dt.
    effort_.cost = std::min(left / reference_.seconds, 2 * best_);
    std::vector<ErrorPoint> points = error_ladder(
        start, reference_, effort_, stop_, [&](std::span<const ErrorPoint> so_far) { return is_enough(so_far); });
    try_between(start, points);
    if (const ErrorPoint* found = cheapest(points, search_.rough, enough_)) best_ = std::min(best_, found->cost);
    search_.points.insert(search_.points.end(), points.begin(), points.end());
  }

 private:
  /// Once it is reached, and once more where a finer one has to confirm it or may be cheaper.
  bool is_enough(std::span<const ErrorPoint> points) const {
    if (cheapest(points, search_.rough, enough_) == nullptr) return false;
    const bool falling = points.size() < 2 || points.back().cost < points[points.size() - 2].cost;
    return !is_implicit(scheme(points.back().integrator)) || (points.size() > 1 && !falling);
  }

  /// A step between the coarsest that reaches the error and the next, which has twice the length.
  void try_between(StudyStart start, std::vector<ErrorPoint>& points) {
    const ErrorPoint* found = cheapest(points, search_.rough, enough_);
    if (found == nullptr || found == points.data() || found->tolerance > 0) return;
    if (found->cost > std::sqrt(2) * best_) return;
    start.preset.dt = std::sqrt(2) * found->dt;
    const auto at = found - points.data();
    if (!(start.preset.dt < 0.95 * points[std::size_t(at) - 1].dt)) return;
    points.insert(points.begin() + at, measure_point(start, reference_, stop_,
                                                     std::min(effort_.cost, 2 * found->cost) * reference_.seconds));
  }

  const StudyStart& start_;
  const StudyReference& reference_;
  SettingsSearch& search_;
  const Stop& stop_;
  StudyEffort effort_;
  double enough_, best_ = std::numeric_limits<double>::infinity(), begun_ = thread_seconds();
};

std::vector<std::string> methods_of(const Preset& preset, const SettingsKeeps& keeps) {
  if (keeps.integrator) return {preset.integrator};
  std::vector<std::string> methods(candidates.begin(), candidates.end());
  const Mode fastest = any_configuration(preset);
  if (fastest.damping > fastest.omega())
    methods.insert(methods.begin(), for_heavy_damping.begin(), for_heavy_damping.end());
  if (preset.engine == EngineKind::opencl)
    std::erase_if(methods, [](const std::string& name) { return !runs_on_opencl(scheme(name)); });
  return methods;
}

void measure_settings(const StudyStart& start, SettingsSearch& search, const Stop& stop, const Found& found) {
  const StudyReference reference = find_reference(start, search, stop, found);
  if (search.goal.present) {
    constexpr double present_patience = 4;  // s of processor time
    search.present = measure_point(start, reference, stop, present_patience);
  }
  found(search);
  Searcher searcher(start, reference, search, stop);
  const std::vector<std::string> methods = methods_of(start.preset, search.goal.keeps);
  search.methods = int(methods.size());
  const auto try_all = [&](Precision precision) {
    search.methods_done = 0;
    for (const std::string& method : methods) {
      if (!searcher.out_of_time()) searcher.try_method(method, precision);
      ++search.methods_done;
      found(search);
    }
  };
  try_all(start.preset.precision);
  const bool more = !search.goal.keeps.precision && start.preset.precision == Precision::float_;
  if (more && !std::isfinite(searcher.best_cost())) try_all(Precision::double_);
}

}  // namespace

double two_digits_above(double value) {
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return rounded(std::ceil(value / unit * (1 - 1e-12)) * unit, 2);
}

double SettingsSearch::part_done() const {
  return (reference_part + (methods > 0 ? double(methods_done) / methods : 0)) / 2;
}

SettingsSearch search_settings(const StudyStart& start, const SettingsGoal& goal, const Stop& stop,
                               const Found& found) {
  SettingsSearch search;
  search.of = start.preset, search.t = start.from ? start.from->t : 0, search.goal = goal;
  search.rough = is_rough(start.preset);
  try {
    measure_settings(start, search, stop, found);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error& error) {
    search.problem = error.what();
  }
  search.done = true;
  found(search);
  return search;
}

std::vector<ErrorPoint> settings_for(const SettingsSearch& search, double tolerance) {
  std::vector<ErrorPoint> reached;
  if (!(search.margin() * search.agreement_rms_m <= tolerance)) return reached;
  for (const auto& method : grouped_by_method(search.points))
    if (const ErrorPoint* best = cheapest(method, search.rough, aim * tolerance)) reached.push_back(*best);
  std::stable_sort(reached.begin(), reached.end(),
                   [](const ErrorPoint& a, const ErrorPoint& b) { return a.cost < b.cost; });
  return reached;
}

double least_reliable_error(const SettingsSearch& search, const ErrorPoint** of) {
  double least = std::numeric_limits<double>::infinity();
  if (of != nullptr) *of = nullptr;
  for (const auto& method : grouped_by_method(search.points)) {
    const std::vector<double> errors = reliable_errors(method, search.rough);
    for (std::size_t n = 0; n < errors.size(); ++n)
      if (errors[n] < least) {
        least = errors[n];
        if (of != nullptr) *of = &method[n];
      }
  }
  return least;
}

double tightest_tolerance(const SettingsSearch& search) {
  const double least = least_reliable_error(search);
  if (!std::isfinite(least)) return least;
  return two_digits_above(std::max(least / aim, search.margin() * search.agreement_rms_m));
}

Preset with_setting(const Preset& preset, const ErrorPoint& point) {
  Preset with = preset;
  with.integrator = point.integrator, with.precision = point.precision;
  if (point.tolerance > 0) {
    with.tolerance = point.tolerance;
  } else {
    with.dt = std::max(two_digits_below(point.dt), least_dt);
  }
  return with;
}

}  // namespace tyglab
