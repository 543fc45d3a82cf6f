
#include "core/analysis/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/integrators/scheme.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

std::int64_t evaluations(const Scheme& scheme, const Simulation& simulation) {
  if (chooses_steps(scheme)) return simulation.engine().inner_steps().force_evaluations;
  if (is_implicit(scheme)) return simulation.engine().solves().force_evaluations;
  // A pass over all springs counts as one.
  if (projects(scheme)) return simulation.steps() * (1 + simulation.preset().iterations);
  return simulation.steps() * std::int64_t(scheme.sweeps.size()) + (scheme.start.empty() ? 0 : 1);
}

/// One run; its time is that of the steps alone.
AccuracyRow run_once(const AccuracyScene& scene, const Reference& reference, const Preset& preset, int steps,
                     const Stop& stop) {
  AccuracyRow row{scene.name, preset.integrator, preset.precision, preset.engine, preset.dt};
  Simulation simulation(preset);
  Track track;
  for (int n = 0; n < accuracy_samples && !simulation.divergence(); ++n) {
    const double start = computing_seconds(preset.engine);
    simulation.advance(steps);
    row.seconds += computing_seconds(preset.engine) - start;
    if (stop()) throw Stopped();
    track.push_back(positions_of(simulation));
  }
  row.steps = simulation.steps();
  if (chooses_steps(scheme(preset.integrator))) {
    row.steps = simulation.engine().inner_steps().accepted;
    row.tolerance = preset.tolerance;
    row.dt = scene.seconds / double(std::max<std::int64_t>(row.steps, 1));
  }
  row.force_evaluations = evaluations(scheme(preset.integrator), simulation);
  row.unconverged = simulation.engine().solves().unconverged;
  if (simulation.divergence()) {
    row.status = AccuracyStatus::diverged, row.error_rms_m = std::numeric_limits<double>::infinity();
  } else {
    row.error_rms_m = rms_distance(track, reference.track);
    row.status = judged(reference, row.error_rms_m);
  }
  return row;
}

}  // namespace

std::string_view name_of(AccuracyStatus status) {
  return status == AccuracyStatus::ok ? "ok" : status == AccuracyStatus::below_floor ? "below_floor" : "diverged";
}

bool can_tell(const Reference& reference, double error_rms_m) {
  return error_rms_m >= reference_margin * reference.agreement_rms_m;
}

AccuracyStatus judged(const Reference& reference, double error_rms_m) {
  if (!std::isfinite(error_rms_m)) return AccuracyStatus::diverged;
  return can_tell(reference, error_rms_m) ? AccuracyStatus::ok : AccuracyStatus::below_floor;
}

std::vector<int> accuracy_ladder(const AccuracyScene& scene, double largest_dt, const AccuracyEffort& effort) {
  std::vector<int> ladder;
  const double part = scene.seconds / accuracy_samples;
  for (int power = 1; part / power >= least_dt && power <= 1 << 28; power *= 2)
    for (const int n : {power, 3 * power / 2}) {
      if (n != power && (!effort.fine || power < 2)) continue;
      if (part / n <= largest_dt && part / n >= least_dt) ladder.push_back(n);
    }
  return ladder;
}

std::vector<double> tolerance_ladder(Precision precision, const AccuracyEffort& effort) {
  const double least = precision == Precision::float_ ? 1e-6 : 1e-12;
  const double ratio = effort.fine ? std::sqrt(10.0) : 10;
  std::vector<double> ladder;
  for (double tolerance = 1e-2; tolerance > least * 0.9; tolerance /= ratio) ladder.push_back(tolerance);
  return ladder;
}

bool worth_going_on(const std::vector<AccuracyRow>& rows, const AccuracyEffort& effort) {
  if (rows.empty()) return true;
  const AccuracyRow& last = rows.back();
  if (last.status == AccuracyStatus::below_floor) return false;
  if (last.status == AccuracyStatus::ok && last.seconds * (effort.fine ? 1.5 : 2) > effort.longest_s) return false;
  // Rounding: the error has grown for three rows. It stays the same where a tolerance asks for nothing yet.
  if (rows.size() < 4 || last.status != AccuracyStatus::ok) return true;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n + 3 < rows.size(); ++n) best = std::min(best, rows[n].error_rms_m);
  return std::any_of(rows.end() - 3, rows.end(), [&](const AccuracyRow& row) { return row.error_rms_m <= best; });
}

namespace {

/// Where a method's ladder begins, s.
double coarsest_dt(const Preset& preset, const Scheme& method) {
  constexpr double a_picture = 1.0 / 30;  // s: what needs no stability is tried from there on
  const double limit = stable_dt(preset, "verlet");
  if (iterates(method)) return std::max(16 * limit, a_picture);
  // Twice the least limit of any configuration, since the cloth may be far from that one.
  return 2 * std::max(limit, stable_dt(preset, std::string(method.name)));
}

/// The scene's preset with each setting to be measured, and how many steps each makes from a sample to the next.
struct Rung {
  Preset preset;
  int steps;
};
std::vector<Rung> settings(const AccuracyScene& scene, const std::string& integrator, Precision precision,
                           const AccuracyEffort& effort) {
  std::vector<Rung> list;
  Preset preset = scene.preset;
  preset.integrator = integrator, preset.precision = precision;
  const double part = scene.seconds / accuracy_samples;
  if (chooses_steps(scheme(integrator))) {
    preset.dt = part;
    for (const double tolerance : tolerance_ladder(precision, effort))
      list.push_back({preset, 1}), list.back().preset.tolerance = tolerance;
    return list;
  }
  for (const int steps : accuracy_ladder(scene, coarsest_dt(preset, scheme(integrator)), effort))
    list.push_back({preset, steps}), list.back().preset.dt = part / steps;
  return list;
}

}  // namespace

std::vector<AccuracyRow> measure_integrator(const AccuracyScene& scene, const Reference& reference,
                                            const std::string& integrator, Precision precision,
                                            const AccuracyEffort& effort, const Stop& stop) {
  std::vector<AccuracyRow> rows;
  std::optional<Simulation> device;  // keeps it open, with its programs built, so that no row's time holds that
  if (scene.preset.engine != EngineKind::cpu) {
    Preset first = scene.preset;
    first.integrator = integrator, first.precision = precision;
    device.emplace(first).advance(2);
  }
  for (const auto& [preset, steps] : settings(scene, integrator, precision, effort)) {
    if (!worth_going_on(rows, effort)) break;
    try {
      AccuracyRow row = run_once(scene, reference, preset, steps, stop);
      for (int n = 0;
           n < effort.repeats && row.seconds < effort.repeated_below_s && row.status != AccuracyStatus::diverged; ++n)
        row.seconds = std::min(row.seconds, run_once(scene, reference, preset, steps, stop).seconds);
      rows.push_back(row);
    } catch (const Stopped&) {
      break;
    }
  }
  return rows;
}

// The summary of `tyglab bench accuracy`: the fastest method for each error.

namespace {

/// Whether the limit of stability lies between two rows: a wild motion, and then a better one than any order explains.
bool stability_between(const AccuracyRow& coarse, const AccuracyRow& fine) {
  if (coarse.status == AccuracyStatus::diverged) return true;
  if (fine.tolerance) return false;
  constexpr double highest_order = 8.5;
  return coarse.error_rms_m > fine.error_rms_m * std::pow(coarse.dt / fine.dt, highest_order);
}

}  // namespace

std::optional<Reached> reached(std::span<const AccuracyRow> rows, double error) {
  const auto good = [&](const AccuracyRow& row) {
    return row.status != AccuracyStatus::diverged && row.error_rms_m <= error;
  };
  const auto first = std::find_if(rows.begin(), rows.end(), good);
  if (first == rows.end()) return std::nullopt;
  if (first == rows.begin() || stability_between(*(first - 1), *first)) return Reached{first->seconds, true};
  const AccuracyRow &coarse = *(first - 1), &fine = *first;
  const double part = std::log(coarse.error_rms_m / error) / std::log(coarse.error_rms_m / fine.error_rms_m);
  const double seconds = coarse.seconds * std::pow(fine.seconds / coarse.seconds, part);
  return Reached{std::min(seconds, fine.seconds), false};
}

std::vector<std::span<const AccuracyRow>> by_method(std::span<const AccuracyRow> rows) {
  std::vector<std::span<const AccuracyRow>> methods;
  const auto differ = [](const AccuracyRow& a, const AccuracyRow& b) {
    return a.scene != b.scene || a.integrator != b.integrator || a.precision != b.precision || a.engine != b.engine;
  };
  for (std::size_t from = 0, n = 1; n <= rows.size(); ++n)
    if (n == rows.size() || differ(rows[n - 1], rows[n])) methods.push_back(rows.subspan(from, n - from)), from = n;
  return methods;
}

std::vector<AccuracyWinner> accuracy_winners(std::span<const AccuracyRow> rows, const Reference& reference) {
  std::vector<AccuracyWinner> winners;
  for (int decade = -2; decade >= -6; --decade) {
    AccuracyWinner winner;
    winner.error_rms_m = std::pow(10, decade);
    if (!can_tell(reference, winner.error_rms_m)) break;
    for (const auto method : by_method(rows)) {
      const auto at = reached(method, winner.error_rms_m);
      if (!at) continue;
      const AccuracyRow& row = method.front();
      if (row.engine != EngineKind::cpu) continue;  // another clock
      if (row.integrator.starts_with("odeint_")) {
        if (winner.odeint.empty() || at->seconds < winner.odeint_seconds)
          winner.odeint = row.integrator, winner.odeint_precision = row.precision, winner.odeint_seconds = at->seconds;
      } else if (winner.integrator.empty() || at->seconds < winner.seconds) {
        winner.scene = row.scene, winner.integrator = row.integrator, winner.precision = row.precision;
        winner.seconds = at->seconds, winner.at_largest_dt = at->at_largest_dt;
      }
    }
    if (!winner.integrator.empty()) winners.push_back(winner);
  }
  return winners;
}

}  // namespace tyglab
