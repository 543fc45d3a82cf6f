#include "core/analysis/statistics.h"

#include <algorithm>
#include <cmath>

#include "core/analysis/in_parallel.h"
#include "core/integrators/names.h"
#include "core/integrators/scheme.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

constexpr double settles = 2;  // s before the means begin
constexpr double block = 1;    // s
constexpr int blocks = 40, looks_a_block = 50;

double mean_height(const State& state) {
  double sum = 0;
  for (const double y : state.x.y) sum += y;
  return sum / double(state.x.y.size());
}

MotionStatistics follow(const AccuracyScene& scene, const std::string& integrator, int count, const Stop& stop) {
  Preset preset = scene.preset;
  preset.integrator = integrator, preset.precision = Precision::double_;
  const Scheme& method = scheme(integrator);
  const double limit = stable_dt(preset, "verlet");
  const double look = block / looks_a_block;
  const double requested_preset = (iterates(method) ? 1.5 : 0.5) * limit;
  const int steps = chooses_steps(method) ? 1 : std::max(1, int(std::ceil(look / requested_preset)));
  preset.dt = look / steps;
  MotionStatistics result{scene.name, integrator, preset.dt, settles, settles + count * block};
  Simulation simulation(preset);
  const double start = simulation.energy().energy.total();
  const auto advance = [&] {
    if (stop()) throw Stopped();
    simulation.advance(steps);
    return !simulation.divergence();
  };
  bool going = true;
  for (int n = 0; n < int(settles / look) && going; ++n) going = advance();
  std::vector<double> heights, energies;
  for (int b = 0; b < count && going; ++b) {
    double height = 0, kinetic = 0;
    for (int n = 0; n < looks_a_block && going; ++n) {
      going = advance();
      if (!going) break;
      height += mean_height(simulation.read()), kinetic += simulation.energy().energy.kinetic;
    }
    heights.push_back(height / looks_a_block), energies.push_back(kinetic / looks_a_block);
  }
  result.diverged = !going;
  if (result.diverged) return result;
  result.height = mean_of_blocks(heights), result.kinetic = mean_of_blocks(energies);
  result.change = (simulation.energy().energy.total() - start) / result.kinetic.mean;
  return result;
}

}  // namespace

TimeMean mean_of_blocks(std::span<const double> means) {
  const auto count = double(means.size());
  TimeMean result;
  for (const double value : means) result.mean += value / count;
  if (means.size() < 2) return result;
  double squares = 0;
  for (const double value : means) squares += (value - result.mean) * (value - result.mean);
  result.error = std::sqrt(squares / (count - 1) / count);
  return result;
}

std::vector<MotionStatistics> measure_statistics(const AccuracyScene& scene, bool quick, int threads,
                                                 const Stop& stop) {
  const auto names = integrator_names();
  std::vector<MotionStatistics> all(names.size());
  std::size_t measured = 0;
  try {
    in_parallel(
        int(names.size()), threads,
        [&](int n) {
          all[std::size_t(n)] = follow(scene, std::string(names[std::size_t(n)]), quick ? blocks / 4 : blocks, stop);
        },
        [&](int) { ++measured; }, stop);
  } catch (const Stopped&) {
  }
  all.resize(measured);
  return all;
}

}  // namespace tyglab
