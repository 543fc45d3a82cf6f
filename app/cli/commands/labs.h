// `tyglab labs`: lists the labs, and checks a lab file.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

/// Adds the command; when it is picked, `action` does it.
void add_labs_command(CLI::App& program, Action& action);

}  // namespace tyglab
