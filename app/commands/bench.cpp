#include "app/commands/bench.h"

#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

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

struct BenchOptions {
  bool quick = false;
  int repeats = 9;
  int threads = 0;  ///< 0: as many as there are processors
  std::string json;

  std::vector<Output> outputs() const { return {{"--json", json}}; }
};

Json row_json(const ThroughputRow& row) {
  const Preset& p = row.of.preset;
  return {{"engine", name_of(p.engine)},
          {"precision", name_of(p.precision)},
          {"integrator", p.integrator},
          {"threads", row.threads_used},
          {"rows", p.rows},
          {"columns", p.columns},
          {"variant", row.of.variant},
          {"ns_per_particle_step", row.ns_per_particle_step},
          {"ns_lowest", row.ns_lowest},
          {"ns_highest", row.ns_highest},
          {"repeats", row.repeats},
          {"register_limit_ns", row.register_limit_ns},
          {"memory_limit_ns", row.memory_limit_ns},
          {"over_register_limit", row.ns_per_particle_step / row.register_limit_ns},
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

int throughput(const BenchOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const Machine machine = this_machine();
  const int threads = options.threads > 0 ? options.threads : machine.cores;
  out << machine.processor << ", " << counted(machine.cores, "core") << ", " << machine.instruction_set
      << "; tyglab " TYGLAB_VERSION ", " << build_description() << "\nns per particle and step: the median of "
      << counted(options.repeats, "run") << ", and the limits of this machine measured beside it\n\n"
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
  if (!options.json.empty()) {
    const Json all = {
        {"benchmark", "throughput"},
        {"machine",
         {{"processor", machine.processor}, {"cores", machine.cores}, {"instruction_set", machine.instruction_set}}},
        {"version", TYGLAB_VERSION},
        {"build", build_description()},
        {"runs", rows}};
    write_output(options.json, all.dump(2) + "\n");
  }
  if (!InterruptGuard::interrupted()) return exit_done;
  progress.clear();
  std::cerr << "tyglab: Interrupted; the figures measured so far are whole.\n";
  return exit_interrupted;
}

}  // namespace

void add_bench_command(CLI::App& program, Action& action) {
  CLI::App* bench = program.add_subcommand("bench", "Measure speed on this machine");
  bench->require_subcommand(1);
  bench->footer("Example: tyglab bench throughput --quick");
  CLI::App* command = bench->add_subcommand(
      "throughput", "Time for one particle and step, for sizes, integrators, precisions, threads and features");
  const auto options = std::make_shared<BenchOptions>();
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
