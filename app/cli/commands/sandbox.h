// `tyglab [PRESET]`: opens the sandbox.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

/// Makes the sandbox what the program does when no command is named.
void add_sandbox_command(CLI::App& program, Action& action);

}  // namespace tyglab
