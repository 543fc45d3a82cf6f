// The replacement of the sandbox on a machine without a display.
#pragma once

#include <iosfwd>

#include "app/shell/sandbox.h"

namespace tyglab {

/// Simulates the preset and writes pictures of it and its last state into a new folder ./tyglab-out, or tyglab-out-2
/// and so on where there is one: nothing is replaced. The screenshot and the time report too, where they are asked for.
/// Shows progress and names the files on `out`. Returns the exit code.
int run_headless(const SandboxOptions& options, std::ostream& out);

}  // namespace tyglab
