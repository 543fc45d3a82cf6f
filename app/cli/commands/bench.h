// `tyglab bench`: the benchmarks, with a table for people and JSON for programs.
#pragma once

#include "app/cli/command_line.h"

namespace tyglab {

void add_bench_command(CLI::App& program, Action& action);

/// Its own commands, a file each: bench_throughput.cpp, bench_accuracy.cpp, …
void add_bench_throughput(CLI::App& bench, Action& action);
void add_bench_accuracy(CLI::App& bench, Action& action);
void add_bench_skip(CLI::App& bench, Action& action);
void add_bench_implicit(CLI::App& bench, Action& action);
void add_bench_one_weight(CLI::App& bench, Action& action);
void add_bench_convergence(CLI::App& bench, Action& action);

}  // namespace tyglab
