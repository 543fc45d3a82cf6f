#include "core/analysis/settings_search.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>

#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/opencl/program_text.h"
#include "core/forces/force.h"
#include "core/integrators/scheme.h"
#include "core/simulation.h"
#include "tyglab_version.h"

namespace tyglab {
namespace {

constexpr int most_side = 1024;  // beyond it nothing is in caches, and a step's time grows with the particles
constexpr double trial_seconds = 0.03;
constexpr int rounds = 3;
constexpr double clearly = 0.95;  // of the CPU engine's time: less is a reason to take another

/// The scene, where it does not run away while it is measured.
Preset measured_preset(Preset preset, const EngineTime& on) {
  preset.rows = std::min(preset.rows, most_side), preset.columns = std::min(preset.columns, most_side);
  std::erase_if(preset.pins.list,
                [&](const Pins::Site& site) { return site.i >= preset.rows || site.j >= preset.columns; });
  preset.dt = std::min(preset.dt, 1e-5);
  preset.engine = on.engine, preset.device = on.device;
  return preset;
}

/// A run of an engine; its shortest time counts, since other work only ever makes it longer.
class Runner {
 public:
  Runner(const Preset& preset, int threads) : simulation_(preset, threads) {
    simulation_.advance(steps_);  // drivers build kernels when they are first used
    while (step(steps_) < trial_seconds && !simulation_.divergence()) steps_ *= 2;
  }
  void run() { shortest_ = std::min(shortest_, step(steps_) / steps_); }
  /// 0: it did not last.
  double ns() const { return simulation_.divergence() ? 0 : 1e9 * shortest_ / double(simulation_.lattice().size()); }

 private:
  double step(int steps) {
    const auto start = std::chrono::steady_clock::now();
    simulation_.advance(steps);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  Simulation simulation_;
  int steps_ = 8;
  double shortest_ = HUGE_VAL;
};

void measure(const Preset& preset, int threads, std::vector<EngineTime>& times) {
  std::vector<std::unique_ptr<Runner>> runners;
  for (EngineTime& time : times) {
    runners.emplace_back();
    try {
      runners.back() = std::make_unique<Runner>(measured_preset(preset, time), threads);
    } catch (const EngineError& error) {
      time.fault = error.what();
    }
  }
  for (int round = 0; round < rounds; ++round)  // in turn: a machine's speed changes
    for (const auto& runner : runners)
      if (runner) runner->run();
  for (std::size_t n = 0; n < times.size(); ++n)
    if (runners[n]) times[n].ns = runners[n]->ns();
}

/// All that times depend on.
std::string key_of(const Preset& p, int threads, const std::vector<OpenClDevice>& devices) {
  const int size = int(std::lround(std::log2(double(p.rows) * p.columns)));
  std::string key = "engine times 1\n" TYGLAB_VERSION "\n" + p.integrator + '\n';
  for (const int number : {int(p.precision), threads, size, int(p.bodies.size()), int(p.F_max > 0)})
    key += std::to_string(number) + ' ';
  for (const Force* force : force::all) key += force->on(p) ? '1' : '0';
  for (const OpenClDevice& device : devices)
    key += '\n' + device.platform + '\n' + device.name + '\n' + device.version + '\n' + device.driver;
  return key;
}

/// Times as they were written; false where they were not.
bool read_times(const std::string& text, std::vector<EngineTime>& times) {
  const char* at = text.c_str();
  for (EngineTime& time : times) {
    char* end = nullptr;
    time.ns = std::strtod(at, &end);
    if (end == at || !(time.ns >= 0)) return false;
    at = end;
  }
  return true;
}

std::string text_of(const std::vector<EngineTime>& times) {
  std::string text;
  for (const EngineTime& time : times) text += std::to_string(time.ns) + '\n';
  return text;
}

std::string ns_text(double ns) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g ns", ns);
  return text;
}

EngineChoice only_cpu(const std::string& why) {
  EngineChoice choice;
  choice.why = "the CPU engine, since " + why;
  return choice;
}

}  // namespace

EngineChoice choose_among(std::vector<EngineTime> times, bool measured) {
  if (!(times[0].ns > 0)) return only_cpu("this scene is too short to be measured");
  EngineChoice choice;
  const EngineTime* best = &times[0];
  const EngineTime* other = nullptr;  // the quickest of those that were not taken
  for (const EngineTime& time : times)
    if (time.ns > 0 && time.ns < clearly * times[0].ns && time.ns < (best == &times[0] ? HUGE_VAL : best->ns))
      best = &time;
  for (const EngineTime& time : times)
    if (&time != best && time.ns > 0 && (other == nullptr || time.ns < other->ns)) other = &time;
  choice.engine = best->engine, choice.device = best->device;
  choice.measured = measured;
  if (other == nullptr) {
    choice.why = best->name + ", since no other engine runs this scene";
    if (times.size() > 1 && !times[1].fault.empty()) choice.why += ": " + times[1].fault;
  } else {
    choice.why = best->name + ": " + ns_text(best->ns) + " per particle and step in this scene, compared with " +
                 ns_text(other->ns) + " with " + other->name +
                 (measured ? ", measured just now" : ", measured in an earlier run");
  }
  choice.times = std::move(times);
  return choice;
}

EngineChoice choose_engine(const Preset& preset, int threads) {
  const Scheme& method = scheme(preset.integrator);
  if (!runs_on_opencl(method)) return only_cpu("no other engine runs " + std::string(method.name));
  if (const Force* force = missing_on_opencl(preset))
    return only_cpu("no device computes " + words_of_missing(*force, method.name));
  const OpenClInventory inventory = opencl_devices();
  if (inventory.devices.empty())
    return only_cpu("there is no OpenCL device" + (inventory.problem.empty() ? "" : " (" + inventory.problem + ")"));
  std::vector<EngineTime> times{{EngineKind::cpu, -1, "the CPU engine", 0, {}}};
  for (int n = 0; n < int(inventory.devices.size()); ++n)
    times.push_back({EngineKind::opencl, n, "OpenCL on " + inventory.devices[std::size_t(n)].name, 0, {}});
  const std::string key = key_of(preset, threads, inventory.devices);
  if (read_times(opencl::kept_on_disk(key), times)) return choose_among(std::move(times), false);
  measure(preset, threads, times);
  opencl::keep_on_disk(key, text_of(times));
  return choose_among(std::move(times), true);
}

}  // namespace tyglab
