// `tyglab try-opencl`, which only the program itself starts (app/process/program_trial.h) and help does not list.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

void add_try_opencl_command(CLI::App& program, Action& action);

}  // namespace tyglab
