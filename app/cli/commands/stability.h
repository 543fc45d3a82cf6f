// `tyglab stability`: the stability experiments, with a table for people and JSON for programs.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

void add_stability_command(CLI::App& program, Action& action);

/// Its own commands, a file each: stability_boundary.cpp, stability_drift.cpp, stability_stress.cpp.
void add_stability_boundary(CLI::App& stability, Action& action);
void add_stability_drift(CLI::App& stability, Action& action);
void add_stability_stress(CLI::App& stability, Action& action);
void add_stability_map(CLI::App& stability, Action& action);

}  // namespace tyglab
