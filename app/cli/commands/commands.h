// The commands of the program. Each function adds one with its options; when it is picked, `action` does it. Both
// arguments must outlive parsing.
#pragma once

#include <CLI/CLI.hpp>

#include "app/cli/command_line.h"

namespace tyglab {

/// Runs the command of the command line. Returns the exit code.
int run_command_line(int argc, char** argv);
/// Adds all commands.
void declare_program(CLI::App& program, Action& action);

/// Makes the sandbox the default action without a command: `tyglab [PRESET]`.
void add_sandbox_command(CLI::App& program, Action& action);
/// `tyglab run`: simulates without a window.
void add_run_command(CLI::App& program, Action& action);
/// `tyglab render`: draws without a window or a display.
void add_render_command(CLI::App& program, Action& action);
/// `tyglab presets`: lists the shipped presets, prints one as JSON, and checks a file.
void add_presets_command(CLI::App& program, Action& action);
/// `tyglab labs`: lists the labs, and checks a lab file.
void add_labs_command(CLI::App& program, Action& action);
/// `tyglab verify`: the gallery of exact and published answers.
void add_verify_command(CLI::App& program, Action& action);
/// `tyglab devices`: lists where a simulation can run.
void add_devices_command(CLI::App& program, Action& action);
/// `tyglab try-opencl`, which only the program itself starts (app/process/program_run.h) and help does not list.
void add_try_opencl_command(CLI::App& program, Action& action);

// `tyglab bench` and `tyglab stability`: experiments, with a table for people and JSON for programs.
void add_bench_throughput(CLI::App& bench, Action& action);
void add_bench_accuracy(CLI::App& bench, Action& action);
void add_bench_skip(CLI::App& bench, Action& action);
void add_bench_implicit(CLI::App& bench, Action& action);
void add_bench_contact(CLI::App& bench, Action& action);
void add_bench_one_weight(CLI::App& bench, Action& action);
void add_bench_convergence(CLI::App& bench, Action& action);
void add_stability_boundary(CLI::App& stability, Action& action);
void add_stability_drift(CLI::App& stability, Action& action);
void add_stability_stress(CLI::App& stability, Action& action);
void add_stability_map(CLI::App& stability, Action& action);

}  // namespace tyglab
