#include "app/cli/commands/stability.h"

namespace tyglab {

void add_stability_command(CLI::App& program, Action& action) {
  CLI::App* stability = program.add_subcommand("stability", "Experiments on the stability of each method");
  stability->require_subcommand(1);
  stability->footer("Example: tyglab stability boundary --quick");
  add_stability_boundary(*stability, action);
  add_stability_drift(*stability, action);
  add_stability_stress(*stability, action);
  add_stability_map(*stability, action);
}

}  // namespace tyglab
