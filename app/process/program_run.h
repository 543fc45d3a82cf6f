// Runs other programs to their end, without a window or a terminal.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

/// How another program ended.
struct ProgramExit {
  std::optional<int> code;  ///< exit code; none if it did not start or was ended by a signal
  int signal = 0;           ///< that ended it; 0: none. On Windows the exception's number
  bool timed_out = false;   ///< it was killed for taking too long
  std::string output;       ///< what it wrote to standard output and error, the first 64 KiB
};

struct ProgramOptions {
  std::string input;        ///< what it reads from its standard input
  double most_seconds = 0;  ///< after which it is killed; 0: never
};

/// Runs another program, none of whose output is seen, and waits for its end. `path` and `arguments`, which begin with
/// its name, are UTF-8.
ProgramExit run_program(const std::string& path, std::vector<std::string> arguments,
                        const ProgramOptions& options = {});

// Tests programs for OpenCL devices in a separate process: drivers that lack a linker, disk space or a sane state end
// the process in which they run.
//
// The child runs a small cloth like an engine, and the driver, or program_text.h, stores the built programs on disk, so
// this process only has to load them. Building here, in a thread, would block the present cloth, since pocl starts no
// kernel while it builds another.

/// Has core try each program in this very program, started as `tyglab try-opencl` (set_program_trial()). What the
/// driver prints there, and nobody is to see, is kept in driver_log() if the trial fails.
void try_programs_in_child();

/// The child's work: everything that an engine's kernels are used for, on the preset's device. `contacts`: with steps
/// that note what bodies stop. Throws EngineError.
void use_all_kernels(const Preset& preset, bool contacts);

/// Has the preset's device build what it would build at the first step and the first look, for a second or more where
/// nothing is kept on disk: here and now. `ledger`: of steps that note what bodies stop. Nothing for other engines; a
/// device that fails says so at the first step.
void run_programs_once(const Preset& preset, bool ledger);

/// opencl.log in the cache folder; empty: nowhere.
std::filesystem::path driver_log();

}  // namespace tyglab
