// `tyglab labs`: the labs there are; a file checked.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

/// Adds the command; when it is picked, `action` does it.
void add_labs_command(CLI::App& program, Action& action);

}  // namespace tyglab
