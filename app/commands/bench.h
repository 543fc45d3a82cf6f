// `tyglab bench`: the benchmarks, a table for people and JSON for programs.
#pragma once

#include "app/commands/command_line.h"

namespace tyglab {

void add_bench_command(CLI::App& program, Action& action);

}  // namespace tyglab
