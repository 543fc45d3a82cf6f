// `tyglab bench throughput`: a table row by row as it is measured.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/commands/bench.h"
#include "app/commands/bench_output.h"
#include "app/commands/interrupt.h"
#include "app/commands/outputs.h"
#include "app/commands/progress.h"
#include "core/analysis/machine.h"
#include "core/analysis/throughput.h"
#include "core/notation/preset_io.h"
#include "core/output/destination.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

struct ThroughputOptions {
  bool quick = false;
  int repeats = 9;
  int threads = 0;  ///< 0: as many as there are processors
  std::string json;

  std::vector<Output> outputs() const { return {{"--json", json}}; }
};

Json row_json(const ThroughputRow& row) {
  const Preset& p = row.of.preset;
  const double limit = std::max(row.register_limit_ns, row.memory_limit_ns);
  return {{"engine", name_of(p.engine)},
          {"precision", name_of(p.precision)},
          {"integrator", p.integrator},
          {"threads", row.threads_used},
          {"rows", p.rows},
          {"columns", p.columns},
          {"variant", row.of.variant},
          {"features", row.features},
          {"skipped", row.skipped},
          {"ns_per_particle_step", row.ns_per_particle_step},
          {"ns_lowest", row.ns_lowest},
          {"ns_highest", row.ns_highest},
          {"repeats", row.repeats},
          {"register_limit_ns", row.register_limit_ns},
          {"memory_limit_ns", row.memory_limit_ns},
          {"over_register_limit", row.ns_per_particle_step / row.register_limit_ns},
          {"over_higher_limit", row.ns_per_particle_step / limit},
          {"bytes_per_particle", row.bytes_per_particle}};
}

void print_row(std::ostream& out, const ThroughputRow& row) {
  const Preset& p = row.of.preset;
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(), "%4d x %-4d  %-6s  %-14s  %7d  %8.2f  %7.2f  %7.2f  %6.2f  %6.1f  %s\n",
                p.rows, p.columns, std::string(name_of(p.precision)).c_str(), p.integrator.c_str(), row.threads_used,
                row.ns_per_particle_step, row.register_limit_ns, row.memory_limit_ns,
                row.ns_per_particle_step / row.register_limit_ns, row.bytes_per_particle, row.of.variant.c_str());
  out << line.data() << std::flush;
  flush_standard_output();  // which sees now, not after all rows, that nobody gets them
}

int throughput(const ThroughputOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const int threads = options.threads > 0 ? options.threads : processors();
  out << machine_line() << "\nns per particle and step: the median of " << counted(options.repeats, "run")
      << ", and the limits of this machine measured beside it\n\n"
      << "      cloth  number  integrator      threads   median  arithm.   memory   ratio  bytes  variant\n"
      << std::flush;
  Json rows = Json::array();
  const auto cases = throughput_cases(options.quick, threads);
  InterruptGuard guard;
  Progress progress("bench throughput");
  for (const ThroughputCase& which : cases) {
    if (InterruptGuard::interrupted()) break;
    const ThroughputRow row = measure_throughput(which, options.repeats);
    progress.clear();
    print_row(out, row);
    rows.push_back(row_json(row));
    progress.update(double(rows.size()) / double(cases.size()));
  }
  progress.clear();
  if (!options.json.empty()) write_output(options.json, bench_json("throughput", rows).dump(2) + "\n");
  return bench_exit();
}

}  // namespace

void add_bench_throughput(CLI::App& bench, Action& action) {
  CLI::App* command = bench.add_subcommand(
      "throughput", "Time for one particle and step, for sizes, integrators, precisions, threads and features");
  const auto options = std::make_shared<ThroughputOptions>();
  command->add_flag("--quick", options->quick, "Fewer sizes; under a minute");
  command
      ->add_option("--repeats", options->repeats,
                   "Runs of which the median is taken (9 if it is not given; fewer should not be quoted)")
      ->type_name("N")
      ->transform(whole_number_between(1, 1000));
  command->add_option("--threads", options->threads, "Threads beside one; otherwise all processors")
      ->type_name("N")
      ->transform(whole_number_between(1, 256));
  add_output(*command, "--json", options->json, "Write the figures for programs; - is standard output")
      ->type_name("F.json");
  command->footer("Example: tyglab bench throughput --json throughput.json");
  command->callback([&action, options] { action = [options] { return throughput(*options); }; });
}

}  // namespace tyglab
