// Runs the program, from its command line to its exit code.
#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command_line.h"

namespace tyglab {

/// Adds all commands with their options. Parsing sets `action` to what the command line asks for; both must outlive it.
void declare_program(CLI::App& program, Action& action);

/// Runs the command of the command line. Returns the exit code.
int run_command_line(int argc, char** argv);

}  // namespace tyglab
