#include "app/process/kernel_prebuild.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <string>

#include "app/process/child.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/vertex_sharing.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/simulation.h"

namespace tyglab {
namespace {

/// As small as it can be with every kernel run that the preset's cloth runs.
Preset miniature(Preset preset) {
  const bool solves = is_implicit(scheme(preset.integrator));
  const int side = solves ? 150 : 16, most = solves ? most_solved_in_one_launch : 0;
  const auto shortened = [&](int length, int other) { return std::min(length, std::max(side, most / other + 1)); };
  preset.columns = shortened(preset.columns, preset.rows), preset.rows = shortened(preset.rows, preset.columns);
  if (preset.pins.mode == Pins::Mode::list) preset.pins = Pins{};
  return preset;
}

/// A file in memory with that text, to be read from its beginning; under 0: none could be made.
int file_of(const std::string& text) {
  const int file = ::memfd_create("preset", MFD_CLOEXEC);
  if (file >= 0 && (::write(file, text.data(), text.size()) != ssize_t(text.size()) || ::lseek(file, 0, SEEK_SET) != 0))
    return ::close(file), -1;
  return file;
}

}  // namespace

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

void prepare_programs(const Preset& preset, bool ledger) {
  const int input = file_of(preset_to_json(miniature(preset)));
  if (input < 0) return;
  const std::string engine = preset.device < 0 ? "opencl" : "opencl:" + std::to_string(preset.device);
  // A time series reads the cloth, which is a kernel too; so does the ledger.
  run_program_silently("/proc/self/exe",
                       {"tyglab", "run", "/dev/stdin", "--steps", "3", "--engine", engine, "--series-every", "1",
                        ledger ? "--ledger" : "--series", "-"},
                       input);
  ::close(input);
}

}  // namespace tyglab
