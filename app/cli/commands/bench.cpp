#include "app/cli/commands/bench.h"

namespace tyglab {

void add_bench_command(CLI::App& program, Action& action) {
  CLI::App* bench = program.add_subcommand("bench", "Measure speed and accuracy on this machine");
  bench->require_subcommand(1);
  bench->footer("Example: tyglab bench throughput --quick");
  add_bench_throughput(*bench, action);
  add_bench_accuracy(*bench, action);
  add_bench_skip(*bench, action);
  add_bench_implicit(*bench, action);
  add_bench_one_weight(*bench, action);
  add_bench_convergence(*bench, action);
}

}  // namespace tyglab
