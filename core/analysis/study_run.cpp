
#include "core/analysis/study_run.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <glm/geometric.hpp>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/theory/advice.h"

namespace tyglab {

std::unique_ptr<Simulation> begin_study(const StudyStart& start, const Preset& preset) {
  Preset on_cpu = preset;
  on_cpu.engine = EngineKind::cpu;
  auto simulation = std::make_unique<Simulation>(on_cpu);
  if (start.from) simulation->restore(*start.from);
  return simulation;
}

double step_effort(const Preset& preset) {
  const Scheme& method = scheme(preset.integrator);
  const double particles = preset.kind == Kind::one_weight ? 1 : double(preset.rows) * preset.columns;
  if (projects(method)) return particles * (1 + preset.iterations);
  return particles * (is_implicit(method) ? 20 : double(method.sweeps.size()));
}

void advance_study(Simulation& simulation, int steps, const Stop& stop) {
  simulation.stop_when(stop);
  const bool stopped = simulation.advance(steps).stopped;
  simulation.stop_when({});
  if (stopped) throw Stopped();
}

double whole_dt(double seconds, double dt, int& steps) {
  const double part = seconds / accuracy_samples;
  steps = std::max(1, int(std::ceil(part / dt - 1e-9)));
  return part / steps;
}

void in_parallel(int count, int threads, const std::function<void(int)>& work, const std::function<void(int)>& finished,
                 const std::function<bool()>& stop) {
  std::mutex mutex;
  std::vector<bool> done(std::size_t(count), false);
  int taken = 0, told = 0;
  std::exception_ptr fault;
  const auto take = [&] {
    const std::lock_guard lock(mutex);
    return fault || taken == count || stop() ? -1 : taken++;
  };
  const auto tell = [&](int n) {
    const std::lock_guard lock(mutex);
    done[std::size_t(n)] = true;
    while (!fault && told < count && done[std::size_t(told)]) finished(told++);
  };
  const auto worker = [&] {
    try {
      for (int n = take(); n >= 0; n = take()) work(n), tell(n);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!fault) fault = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(std::size_t(std::max(threads, 1)));
  try {
    for (int n = 1; n < std::min(threads, count); ++n) others.emplace_back(worker);
  } catch (const std::system_error&) {
    // The system gives no more threads: fewer do the work.
  }
  worker();
  for (std::thread& other : others) other.join();
  if (fault) std::rethrow_exception(fault);
}

namespace {

constexpr int news_looks = 100;  // at the springs, in the whole time

/// The settings of the run, of which `steps` lie between two looks.
Preset news_settings(const Preset& preset, double seconds, int& steps) {
  Preset coarse = preset;
  coarse.integrator = "velocity_verlet", coarse.precision = Precision::double_;
  const double look = seconds / news_looks;
  const double stable = advised_dt(coarse, coarse.integrator);
  steps = stable > 0 ? std::max(1, int(std::ceil(look / stable))) : news_looks;
  coarse.dt = look / steps;
  return coarse;
}

}  // namespace

double last_event_effort(const Preset& preset, double seconds) {
  int steps = 1;
  const Preset coarse = news_settings(preset, seconds, steps);
  return step_effort(coarse) * steps * news_looks;
}

double time_of_last_event(const StudyStart& start, double seconds, const Stop& stop) {
  int steps = 1;
  const auto of = begin_study(start, news_settings(start.preset, seconds, steps));
  Simulation& simulation = *of;
  const bool bodies = !start.preset.bodies.empty();
  if (bodies) simulation.engine().note_contacts(true);
  const int torn = simulation.tears().torn_count();
  // Less than the weight of a particle is no pull: springs of a cloth that falls freely carry rounding errors.
  const ForceSummary first = simulation.forces(Reduction::maximum);
  double strongest = std::max(first["F_s"], first["F_g"]), news = 0;
  for (int look = 1; look <= news_looks; ++look) {
    for (int step = 0; step < steps; ++step) {
      advance_study(simulation, 1, stop);
      const bool touches = bodies && !simulation.engine().contacts().empty();
      if (touches || simulation.tears().torn_count() > torn || simulation.divergence()) return seconds;
    }
    const double pull = simulation.forces(Reduction::maximum)["F_s"];
    if (pull > 2 * strongest) strongest = pull, news = seconds * look / news_looks;
  }
  return news;
}

double hardest_blow(const StudyStart& start, double seconds, const Stop& stop) {
  if (start.preset.bodies.empty()) return 0;
  int steps = 1;
  const auto of = begin_study(start, news_settings(start.preset, seconds, steps));
  Simulation& simulation = *of;
  simulation.engine().note_contacts(true);
  double hardest = 0;
  for (int step = 0; step < steps * news_looks && !simulation.divergence(); ++step) {
    advance_study(simulation, 1, stop);
    for (const Contact& contact : simulation.engine().contacts()) hardest = std::max(hardest, glm::length(contact.v));
  }
  return hardest;
}

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
