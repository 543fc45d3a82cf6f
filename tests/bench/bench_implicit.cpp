// `tyglab bench implicit`: a table, printed row by row during the measurement.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include "app/cli/bench_output.h"
#include "app/cli/command_line.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/process/interrupt.h"
#include "core/analysis/machine.h"
#include "core/io/output_file.h"
#include "core/model/words.h"
#include "tests/bench/implicit_bench.h"
#include "tests/bench/throughput.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

/// What four times the particles cost: a step's time over that of the same scene with half the rows and columns;
/// nothing if that was not measured.
std::optional<double> growth(const std::vector<ImplicitRow>& rows, const ImplicitRow& row) {
  const auto coarser = std::find_if(rows.begin(), rows.end(), [&](const ImplicitRow& other) {
    const Preset &a = other.preset, &b = row.preset;
    return 2 * a.rows == b.rows && 2 * a.columns == b.columns && a.k_s == b.k_s && a.dt == b.dt;
  });
  if (coarser == rows.end()) return {};
  return row.ms_per_step / coarser->ms_per_step;
}

Json implicit_json(const ImplicitRow& row, std::optional<double> growth) {
  const Preset& p = row.preset;
  return {{"integrator", p.integrator},
          {"precision", name_of(p.precision)},
          {"threads", row.threads},
          {"rows", p.rows},
          {"columns", p.columns},
          {"k_s", p.k_s},
          {"dt", p.dt},
          {"steps", row.steps},
          {"ms_per_step", row.ms_per_step},
          {"growth", growth ? Json(*growth) : Json()},
          {"newton_per_step", row.newton_per_step},
          {"linear_per_step", row.linear_per_step},
          {"residual", row.residual},
          {"strain_error", row.strain_error},
          {"bytes_per_particle", row.bytes_per_particle},
          {"converged", row.converged}};
}

void print_implicit(std::ostream& out, const ImplicitRow& row, std::optional<double> growth) {
  const Preset& p = row.preset;
  std::array<char, 16> times = {"-"};
  if (growth) std::snprintf(times.data(), times.size(), "%.1f", *growth);
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(),
                "%4d x %-4d  %8.0f  %8.5f  %9.2f  %6s  %7.1f  %8.1f  %9.1e  %9.1e  %6.0f  %s\n", p.rows, p.columns,
                p.k_s, p.dt, row.ms_per_step, times.data(), row.newton_per_step, row.linear_per_step, row.residual,
                row.strain_error, row.bytes_per_particle, row.converged ? "yes" : "no");
  out << line.data() << std::flush;
  flush_standard_output();
}

int implicit_steps(const BenchOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  out << machine_line()
      << "\nsteps of implicit_euler in double, the hanging cloth: median time, what four times the particles cost, "
         "iterations\nand linear iterations of a step, the largest residual in parts of the largest force, and the "
         "largest strain's error\n\n      cloth  k_s, N/m     dt, s   ms/step  growth   newton    linear   residual"
         "  strain e.   bytes  converged\n";
  const auto cases = implicit_cases(options.quick);
  std::vector<ImplicitRow> rows;
  Json json = Json::array();
  InterruptGuard guard;
  Progress progress("bench implicit");
  wake_processor();
  for (const Preset& which : cases) {
    if (InterruptGuard::interrupted()) break;
    const ImplicitRow row = measure_implicit(which, options.threads > 0 ? options.threads : 1);
    progress.clear();
    print_implicit(out, row, growth(rows, row));
    json.push_back(implicit_json(row, growth(rows, row)));
    rows.push_back(row);
    progress.update(double(json.size()) / double(cases.size()));
  }
  progress.clear();
  if (!options.json.empty()) write_output(options.json, json_text(bench_json("implicit", json)), bench_reach());
  return bench_exit(options.outputs());
}

}  // namespace

void add_bench_implicit(CLI::App& bench, Action& action) {
  CLI::App* command = bench.add_subcommand(
      "implicit", "Time, iterations and residual of an implicit step, for sizes, stiffnesses and time steps");
  const auto options = std::make_shared<BenchOptions>();
  add_quick(*command, *options, "Fewer sizes and time steps");
  add_threads(*command, *options, "Number of threads", "one");
  add_json(*command, *options);
  command->footer("Example: tyglab bench implicit --quick --json implicit.json");
  command->callback([&action, options] { action = [options] { return implicit_steps(*options); }; });
}

}  // namespace tyglab
