#include "app/process/program_run.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "app/base/settings.h"
#include "app/process/child.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/opencl/program_text.h"
#include "core/engines/vertex_sharing.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/simulation.h"

namespace tyglab {
namespace {

constexpr double most_seconds = 180;  // all kernels of an implicit method take ten on a busy machine

/// A small cloth of mild constants whose kernels are those of the preset: its methods, its features, its kind of size.
Preset small_cloth(const Preset& preset) {
  Preset small;
  small.kind = preset.kind, small.integrator = preset.integrator, small.precision = preset.precision;
  small.engine = preset.engine, small.device = preset.device;
  const bool solves = is_implicit(scheme(preset.integrator));
  const int side = solves ? 150 : 512, most = solves ? most_solved_in_one_launch : 0;
  const auto shortened = [&](int length, int other) { return std::min(length, std::max(side, most / other + 1)); };
  small.columns = shortened(preset.columns, preset.rows), small.rows = shortened(preset.rows, small.columns);
  if (!force::damping.on(preset)) small.k_d = 0;
  if (!force::bend.on(preset)) small.k_b = 0;
  if (preset.W != glm::dvec3(0)) small.W = {0, 0, 1e-4};
  if (force::air.on(preset)) small.air_density = 1;
  small.bodies = preset.bodies;
  return small;
}

/// Where what the driver printed stands, as a sentence, and how it begins.
std::string chatter_words(const std::string& chatter) {
  if (chatter.empty()) return {};
  std::string first = chatter.substr(0, chatter.find('\n'));
  constexpr std::size_t most = 200;
  if (first.size() > most) first = first.substr(0, most) + "…";
  std::string words = " Its output: " + first + ".";
  const std::filesystem::path log = driver_log();
  std::error_code error;
  if (log.empty() || (std::filesystem::create_directories(log.parent_path(), error), error)) return words;
  try {
    write_atomically(log, chatter);
  } catch (const OutputError&) {
    return words;  // there may be no room for it either
  }
  return words + " The complete output is in " + log.string() + ".";
}

/// What became of the child, as part of a sentence; empty if it ended in good order.
std::string death_of(const ProgramExit& exit) {
  constexpr int exit_done = 0, exit_engine = 5;  // ExitCode of app/cli/command_line.h
  if (exit.timed_out) return "did not finish within three minutes";
  if (exit.signal != 0) return "crashed (" + signal_words(exit.signal) + ")";
  if (exit.code && exit.code != exit_done && exit.code != exit_engine)
    return "ended the process (exit code " + std::to_string(*exit.code) + ")";
  return {};
}

std::string try_in_child(const Preset& preset, bool contacts) {
  std::vector<std::string> arguments{"tyglab", "try-opencl", "--device", std::to_string(preset.device)};
  if (contacts) arguments.emplace_back("--contacts");
  const ProgramExit exit = run_program(this_program_again(), std::move(arguments),
                                       {.input = preset_to_json(small_cloth(preset)), .most_seconds = most_seconds});
  const std::string death = death_of(exit);
  if (death.empty()) return {};
  return "The OpenCL driver " + death + " when a separate process tried the kernels." + chatter_words(exit.output) +
         " " + std::string(opencl::how_to_mend_a_driver()) + ", or use the CPU engine (--engine cpu).";
}

}  // namespace

std::filesystem::path driver_log() {
  const std::filesystem::path folder = opencl::cache_folder();
  return folder.empty() ? folder : folder / "opencl.log";
}

void try_programs_in_child() {
  set_program_trial(try_in_child);
}

void use_all_kernels(const Preset& preset, bool contacts) {
  Simulation simulation(preset);
  if (contacts) simulation.enable_ledger(true);
  simulation.advance(2);
  const int i = simulation.lattice().rows - 1, j = simulation.lattice().columns / 2;
  if (preset.kind == Kind::cloth) simulation.apply(edit::Grab{i, j});
  simulation.apply(edit::MoveHand{simulation.position(i, j) + glm::dvec3(0, 0, 1e-3), 1});
  simulation.advance(1);
  simulation.apply(edit::Release{});
  Preset next = simulation.preset();
  next.dt /= 2, next.F_max = 1e-9;  // what lags is moved to the new dt, and springs tear
  simulation.apply(edit::Change{next});
  simulation.advance(2);
  drawn_positions(simulation.engine());
  simulation.read();
}

void run_programs_once(const Preset& preset, bool ledger) {
  if (preset.engine != EngineKind::opencl) return;
  try {
    Simulation simulation(preset);
    if (ledger) simulation.enable_ledger(true);
    simulation.advance(1);
    drawn_positions(simulation.engine());
  } catch (const EngineError&) {
    // The cloth itself will meet it, where it is reported.
  }
}

}  // namespace tyglab
