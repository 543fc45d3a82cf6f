// Facts about devices and methods that need no device.
#include "core/engines/opencl/opencl_devices.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "core/cloth/state.h"
#include "core/engines/engine.h"
#include "core/engines/opencl/program_text.h"
#include "core/forces/parted.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

std::mutex trial_mutex;  // of what follows
ProgramTrial program_trial;
std::map<std::string, std::string> tried;  ///< what came of each trial, by device and program

/// Drivers build other kernels for small grids than for large ones.
std::string size_class(const Preset& preset) {
  constexpr int small_grid = 1 << 16;
  const int size = lattice_of(preset).size();
  return size <= most_solved_in_one_launch ? "small" : size <= small_grid ? "middle" : "large";
}

}  // namespace

void set_program_trial(ProgramTrial trial) {
  const std::lock_guard lock(trial_mutex);
  program_trial = std::move(trial);
  tried.clear();
}

void try_program(const Preset& preset, bool contacts) {
  const std::string key = std::to_string(preset.device) + ' ' + preset.integrator + ' ' + size_class(preset) +
                          (preset.precision == Precision::double_ ? " double" : " float") +
                          opencl::program_features(preset, contacts);
  const std::lock_guard lock(trial_mutex);  // who wants the same program waits for its trial
  if (!program_trial) return;
  auto known = tried.find(key);
  if (known == tried.end()) known = tried.emplace(key, program_trial(preset, contacts)).first;
  if (!known->second.empty()) throw EngineError(known->second);
}

int preferred_device(const std::vector<OpenClDevice>& devices) {
  const auto card =
      std::find_if(devices.begin(), devices.end(), [](const OpenClDevice& device) { return device.card; });
  return card == devices.end() ? 0 : int(card - devices.begin());
}

bool runs_on_opencl(const Scheme& method) {
  return !projects(method) && !chooses_steps(method) && !solves_damping(method) && !counts_passes(method);
}

const Force* missing_on_opencl(const Preset& preset) {
  for (const Force* force : {&force::curl, &force::self})
    if (force->on(preset)) return force;
  if (parts(preset)) return &force::stretch;
  return force::air.on(preset) && is_implicit(scheme(preset.integrator)) ? &force::air : nullptr;
}

std::string words_of_missing(const Force& force, std::string_view method) {
  if (&force == &force::stretch) return "tearing.mode split";
  return std::string(force.symbol) + (&force == &force::air ? " with " + std::string(method) : "");
}

std::string opencl_problem(const Preset& preset) {
  const Scheme& method = scheme(preset.integrator);
  const char* why = projects(method)         ? "moves particles one by one"
                    : solves_damping(method) ? "solves equations for the damping"
                    : counts_passes(method)  ? "makes a fixed number of passes"
                                             : "chooses its own steps";
  if (!runs_on_opencl(method))
    return "The OpenCL engine does not run " + std::string(method.name) + ", which " + why +
           "; use the CPU engine (--engine cpu), or an integrator that it runs, such as verlet";
  const Force* missing = missing_on_opencl(preset);
  if (missing == nullptr) return {};
  return "The OpenCL engine does not compute " + words_of_missing(*missing, preset.integrator) +
         "; use the CPU engine (--engine cpu)" +
         (missing == &force::air       ? ", an explicit method such as verlet, or air_density = 0"
          : missing == &force::self    ? " or self = off"
          : missing == &force::stretch ? " or tearing.mode = springs"
                                       : " or kappa_warp = kappa_weft = 0");
}

}  // namespace tyglab
