// `tyglab presets`: the shipped presets; one as JSON; a file checked.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

/// Adds the command; when it is picked, `action` does it.
void add_presets_command(CLI::App& program, Action& action);

}  // namespace tyglab
