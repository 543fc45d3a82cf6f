#include "tests/bench/drift.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/boundary.h"

namespace tyglab {
namespace {

constexpr int samples_per_run = 400;

/// The largest kinetic energy in the first steps, by Verlet: the same measure for every method.
double energy_of_motion(Preset preset) {
  preset.integrator = "verlet";
  Simulation simulation(preset);
  double most = 0;
  for (int n = 0; n <= 100; ++n, simulation.advance(20)) most = std::max(most, simulation.energy().energy.kinetic);
  return most;
}

/// The least-squares line through the row's samples.
void fit(DriftRow& row) {
  const std::size_t count = row.t.size();
  if (count < 3 || row.motion == 0) return;
  double mean_t = 0, mean_e = 0, tt = 0, te = 0, rest = 0;
  for (std::size_t n = 0; n < count; ++n) mean_t += row.t[n] / double(count), mean_e += row.energy[n] / double(count);
  for (std::size_t n = 0; n < count; ++n) {
    const double t = row.t[n] - mean_t;
    tt += t * t, te += t * (row.energy[n] - mean_e);
  }
  const double slope = te / tt, span = row.t.back() - row.t.front();
  for (std::size_t n = 0; n < count; ++n) {
    const double off = row.energy[n] - mean_e - slope * (row.t[n] - mean_t);
    rest += off * off;
  }
  row.trend = slope * span / row.motion;
  row.trend_error = std::sqrt(rest / double(count - 2) / tt) * span / row.motion;
}

}  // namespace

std::vector<DriftCase> drift_cases(bool quick) {
  constexpr int side = 10;
  const std::int64_t steps = quick ? 20000 : 1000000;
  Preset taut = taut_sheet(side, 50, 0, "verlet");
  taut.v_0 = {0.02, 0, 0.05};  // so slow that every spring stays taut
  Preset slack = slack_cloth(side, 0, "verlet");
  std::vector<DriftCase> cases;
  const auto add = [&](const char* scene, const Preset& preset, std::string_view integrator, double part) {
    DriftCase next{scene, preset, steps, part};
    // The limit is the one for any configuration, since a slack sheet's own changes all the time.
    next.preset.dt = part * dt_crit(scheme("verlet"), std::vector<Mode>{any_configuration(preset)});
    next.preset.integrator = integrator;
    cases.push_back(next);
  };
  for (const Scheme& method : schemes())
    add("taut_sheet", taut, method.name, 0.5), add("slack_sheet", slack, method.name, 0.5);
  for (const double part : {0.25, 0.125}) add("slack_sheet", slack, "verlet", part);
  return cases;
}

DriftRow measure_drift(const DriftCase& which, const std::function<bool()>& stop) {
  DriftRow row;
  row.of = which;
  row.motion = energy_of_motion(which.preset);
  Simulation simulation(which.preset);
  const double start = simulation.energy().energy.total();
  for (int n = 0; n <= samples_per_run && !stop(); ++n) {
    const std::int64_t until = which.steps * n / samples_per_run;
    if (simulation.advance(int(until - simulation.steps())).diverged) {
      row.diverged_at = simulation.divergence()->step;
      break;
    }
    row.t.push_back(simulation.time()), row.energy.push_back(simulation.energy().energy.total() - start);
  }
  if (!row.energy.empty()) {
    const auto [lowest, highest] = std::minmax_element(row.energy.begin(), row.energy.end());
    row.lowest = *lowest, row.highest = *highest;
  }
  if (row.diverged_at == 0) fit(row);
  row.unconverged = simulation.engine().solves().unconverged;
  return row;
}

}  // namespace tyglab
