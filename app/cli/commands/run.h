// `tyglab run`: simulates without a window.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

/// Adds the command; when it is picked, `action` does it.
void add_run_command(CLI::App& program, Action& action);

}  // namespace tyglab
