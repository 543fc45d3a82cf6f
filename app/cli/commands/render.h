// `tyglab render`: draws without a window or a display.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

/// Adds the command; when it is picked, `action` does it.
void add_render_command(CLI::App& program, Action& action);

}  // namespace tyglab
