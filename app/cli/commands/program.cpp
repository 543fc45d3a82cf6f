
#include "app/cli/commands/commands.h"

#include "app/process/child.h"
#include "app/process/process.h"
#include "app/process/program_run.h"
#include "core/io/terminal.h"
#include "tyglab_version.h"

namespace tyglab {
namespace {

void add_bench_command(CLI::App& program, Action& action) {
  CLI::App* bench = program.add_subcommand("bench", "Measure speed and accuracy on this machine");
  bench->require_subcommand(1);
  bench->footer("Example: tyglab bench throughput --quick");
  add_bench_throughput(*bench, action);
  add_bench_accuracy(*bench, action);
  add_bench_skip(*bench, action);
  add_bench_implicit(*bench, action);
  add_bench_contact(*bench, action);
  add_bench_one_weight(*bench, action);
  add_bench_convergence(*bench, action);
}

void add_stability_command(CLI::App& program, Action& action) {
  CLI::App* stability = program.add_subcommand("stability", "Experiments on the stability of each method");
  stability->require_subcommand(1);
  stability->footer("Example: tyglab stability boundary --quick");
  add_stability_boundary(*stability, action);
  add_stability_drift(*stability, action);
  add_stability_stress(*stability, action);
  add_stability_map(*stability, action);
}

}  // namespace

void declare_program(CLI::App& program, Action& action) {
  program.set_version_flag("--version", "tyglab " TYGLAB_VERSION);
  program.footer(
      "Examples: tyglab denim\n"
      "          tyglab run denim --seconds 2 --state denim.csv\n"
      "`tyglab COMMAND --help` describes a command.");
  add_sandbox_command(program, action);
  add_run_command(program, action);
  add_render_command(program, action);
  add_presets_command(program, action);
  add_labs_command(program, action);
  add_bench_command(program, action);
  add_stability_command(program, action);
  add_verify_command(program, action);
  add_devices_command(program, action);
  add_try_opencl_command(program, action);
}

int run_command_line(int argc, char** argv) {
  filter_standard_streams();
  secure_standard_streams();
  const CrashExplainer until_the_end;
  probe_drivers_in_child();
  try_programs_in_child();
  const std::vector<std::string> words = program_arguments(argc, argv);
  Action action;
  CLI::App program(
      "Tyglab: a sandbox in which a simulated cloth shows how numerical methods work and fail.\n"
      "Without a command it opens the sandbox with PRESET, or with the last session.",
      "tyglab");
  declare_program(program, action);
  try {
    program.parse(
        std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes them from the last to the first
  } catch (const CLI::ParseError& error) {
    return exit_of_parsing(program, error, words);
  }
  const int code = run_action(action);
  show_last_words(code);
  return code;
}

}  // namespace tyglab
