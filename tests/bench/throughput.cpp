#include "tests/bench/throughput.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "core/analysis/machine.h"
#include "core/engines/cpu/row_update.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/integrators/scheme.h"
#include "core/simulation.h"

namespace tyglab {
namespace {

/// The default cloth with that many particles a side: stretch, bending, damping and gravity; pinned at two corners.
Preset cloth_of(int side) {
  Preset preset;
  preset.rows = preset.columns = side;
  // Euler and improved Euler are measured too: a step must be short enough that they stay finite while it lasts.
  preset.dt = 1e-5;
  return preset;
}

constexpr int shortest_run = 16;  // steps: as many as follow each other through the rows at a time

double seconds_of(Simulation& simulation, int steps) {
  const auto start = std::chrono::steady_clock::now();
  simulation.advance(steps);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Steps that take about so long; tries until that is known, which also warms up.
int steps_that_take(double wanted, Simulation& simulation) {
  int steps = 4;
  double seconds = seconds_of(simulation, steps);
  while (seconds < 2e-3) steps *= 2, seconds = seconds_of(simulation, steps);
  return std::max(shortest_run, int(steps * wanted / seconds));
}

/// What a simulation of that case tells, and the times of its runs, in ns for a particle and step.
ThroughputRow row_of(const ThroughputCase& which, const Simulation& simulation, const std::vector<double>& times) {
  ThroughputRow row;
  row.of = which;
  row.repeats = int(times.size());
  row.ns_per_particle_step = median(times);
  const auto [lowest, highest] = std::minmax_element(times.begin(), times.end());
  row.ns_lowest = *lowest, row.ns_highest = *highest;
  for (const auto& [name, on] : simulation.engine().features()) (on ? row.features : row.skipped).emplace_back(name);
  row.threads_used = simulation.engine().threads();
  if (which.preset.engine == EngineKind::opencl) row.device = simulation.engine().name();
  if (row.threads_used < which.threads) row.of.variant = "too small for " + std::to_string(which.threads) + " threads";
  row.bytes_per_particle = double(simulation.engine().bytes()) / simulation.lattice().size();
  return row;
}

/// Threads that keep processors busy while it lives.
class Load {
 public:
  explicit Load(int threads) {
    try {
      for (int n = 0; n < threads; ++n)
        threads_.emplace_back([this] {
          while (!over_) {
          }
        });
    } catch (...) {
      end();
      throw;
    }
  }
  ~Load() { end(); }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  void end() {
    over_ = true;
    for (std::thread& thread : threads_) thread.join();
  }
  std::atomic<bool> over_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace

double median(std::vector<double> values) {
  assert(!values.empty());
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void wake_processor() {
  Simulation simulation(cloth_of(128));
  for (double seconds = 0; seconds < 0.5;) seconds += seconds_of(simulation, shortest_run);
}

std::vector<ThroughputCase> throughput_cases(bool quick, int threads) {
  std::vector<ThroughputCase> cases;
  const auto add = [&](std::string variant, int side, int with, auto change) {
    ThroughputCase which{std::move(variant), cloth_of(side), with};
    change(which.preset);
    cases.push_back(which);
  };
  const auto plain = [](Preset&) {};
  const std::vector<int> sides =
      quick ? std::vector{32, 128, 256, 512, 1024} : std::vector{32, 64, 128, 256, 512, 1024, 2048};
  for (const int side : sides) {
    add("", side, 1, plain);
    if (threads > 1) add("", side, threads, plain);
    if (!quick || side == 128) add("", side, 1, [](Preset& p) { p.precision = Precision::double_; });
  }
  for (const Scheme& method : schemes())
    if (method.name != Preset{}.integrator && !is_implicit(method))
      add("", 128, 1, [&](Preset& p) { p.integrator = method.name; });
  add("without bending", 128, 1, [](Preset& p) { p.k_b = 0; });
  add("without damping", 128, 1, [](Preset& p) { p.k_d = 0; });
  add("wind", 128, 1, [](Preset& p) { p.W = {0, 0, 1e-3}; });
  add("tearing watched", 128, 1, [](Preset& p) { p.F_max = 1e6; });
  add("sphere and plane", 128, 1, [](Preset& p) {
    p.bodies = {Body{}, Body{.shape = Body::Shape::plane, .y = -100}};
    p.bodies[0].c = {0, 50, 0};
  });
  add("left column pinned", 128, 1, [](Preset& p) { p.pins.mode = Pins::Mode::left_column; });
  for (const auto& [variant, rows] : {std::pair("one row parted", 1), std::pair("a tenth of the sites parted", 13)}) {
    add(variant, 128, 1, [](Preset& p) { p.tearing = "split"; });
    cases.back().rows_cut = rows;
  }
  // All of the device's compute units; beside the CPU engine with as many threads.
  if (opencl_devices().devices.empty()) return cases;
  const auto on_opencl = [](Preset& p) { p.engine = EngineKind::opencl; };
  for (const int side : sides) {
    if (quick && side != 512) continue;
    add("", side, threads, on_opencl);
    if (!quick) add("", side, threads, [&](Preset& p) { on_opencl(p), p.precision = Precision::double_; });
  }
  return cases;
}

ThroughputRow measure_throughput(const ThroughputCase& which, int repeats) {
  Simulation simulation(which.preset, which.threads);
  for (int n = 0; n < which.rows_cut; ++n) {
    edit::CutSprings cut;
    for (int j = 0; j < which.preset.columns; ++j)
      cut.springs.push_back({1, (2 * n + 1) * which.preset.rows / (2 * which.rows_cut), j});
    simulation.apply(cut);
  }
  const double particles = simulation.lattice().sites().size();
  const int steps = steps_that_take(1e-2, simulation);
  std::vector<double> times;
  times.reserve(std::size_t(repeats));
  for (int n = 0; n < repeats; ++n) times.push_back(seconds_of(simulation, steps) * 1e9 / steps / particles);
  assert(!simulation.divergence());
  ThroughputRow row = row_of(which, simulation, times);
  // The limits are this processor's, in that many threads.
  if (row.threads_used > processors()) return row;
  row.register_limit_ns = cpu::register_limit_ns(which.preset.precision, 15) / row.threads_used;
  const std::size_t moved = std::size_t(particles) * 6 * (which.preset.precision == Precision::float_ ? 4 : 8);
  row.memory_limit_ns = memory_limit_ns(moved, row.threads_used, 5) / particles;
  return row;
}

std::vector<ThroughputCase> cases_beside_load(bool quick, int threads) {
  std::vector<ThroughputCase> cases;
  for (const int side : quick ? std::vector{32, 64, 512} : std::vector{32, 64, 128, 256, 512})
    cases.push_back({"", cloth_of(side), threads});
  return cases;
}

std::array<ThroughputRow, 2> measure_beside_load(const ThroughputCase& which, int busy, int repeats) {
  const Load load(busy);
  ThroughputCase alone = which;
  alone.threads = 1;
  Simulation one(alone.preset, 1), many(which.preset, which.threads);
  const int steps = steps_that_take(3e-2, one);
  for (int n = 0; n < 3; ++n) seconds_of(many, steps);  // until it has found how many threads pay
  std::vector<double> times_of_one, times_of_many, ratios;
  const double per = 1e9 / steps / one.lattice().size();
  for (int n = 0; n < repeats; ++n) {
    // A scheduler may favor whoever comes second: each does in turn.
    if (n % 2 == 0) times_of_one.push_back(seconds_of(one, steps) * per);
    times_of_many.push_back(seconds_of(many, steps) * per);
    if (n % 2 != 0) times_of_one.push_back(seconds_of(one, steps) * per);
    ratios.push_back(times_of_many.back() / times_of_one.back());
  }
  std::array rows{row_of(alone, one, times_of_one), row_of(which, many, times_of_many)};
  for (ThroughputRow& row : rows) row.beside_load = busy;
  rows[0].over_one_thread = 1, rows[1].over_one_thread = median(ratios);
  return rows;
}

}  // namespace tyglab
