// What the sandbox does where there is no display.
#pragma once

#include "app/sandbox/sandbox.h"

namespace tyglab {

/// Simulates the preset and writes pictures of it and its last state into ./tyglab-out; the screenshot and the time
/// report too, where they are asked for. Shows progress and names the files. Returns the exit code.
int run_headless(const SandboxOptions& options);

}  // namespace tyglab
