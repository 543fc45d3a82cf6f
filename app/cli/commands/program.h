// The program from its command line to its exit code.
#pragma once

namespace tyglab {

/// Picks a command, and does what it says. Returns the exit code.
int run_program(int argc, char** argv);

}  // namespace tyglab
