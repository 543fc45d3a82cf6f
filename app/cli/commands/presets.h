// `tyglab presets`: lists the shipped presets, prints one as JSON, and checks a file.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

/// Adds the command; when it is picked, `action` does it.
void add_presets_command(CLI::App& program, Action& action);

}  // namespace tyglab
