// `tyglab bench throughput`: a table, printed row by row during the measurement.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <string_view>

#include "app/cli/bench_output.h"
#include "app/cli/command_line.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/process/interrupt.h"
#include "app/ui/kit/chart.h"
#include "core/analysis/machine.h"
#include "core/io/output_file.h"
#include "core/model/words.h"
#include "tests/bench/throughput.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

struct ThroughputOptions : BenchOptions {
  int repeats = 9;
  bool beside_load = false;
};

Json row_json(const ThroughputRow& row) {
  const Preset& p = row.of.preset;
  const double limit = std::max(row.register_limit_ns, row.memory_limit_ns);
  const auto over = [&](double of) { return of > 0 ? Json(row.ns_per_particle_step / of) : Json(); };
  return {{"engine", name_of(p.engine)},
          {"device", row.device},
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
          {"over_register_limit", over(row.register_limit_ns)},
          {"over_higher_limit", over(limit)},
          {"bytes_per_particle", row.bytes_per_particle},
          {"beside_load", row.beside_load},
          {"over_one_thread", row.over_one_thread > 0 ? Json(row.over_one_thread) : Json()}};
}

/// As wide as the longest name of an integrator among the cases.
int integrator_width(const std::vector<ThroughputCase>& cases) {
  std::size_t width = std::string_view("integrator").size();
  for (const ThroughputCase& which : cases) width = std::max(width, which.preset.integrator.size());
  return int(width);
}

void print_head(std::ostream& out, int integrator_width) {
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(),
                "      cloth  engine  number  %-*s  threads    median  arithm.   memory   ratio   bytes  variant\n",
                integrator_width, "integrator");
  out << line.data() << std::flush;
}

void print_row(std::ostream& out, const ThroughputRow& row, int integrator_width) {
  const Preset& p = row.of.preset;
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(), "%4d x %-4d  %-6s  %-6s  %-*s  %7d  %8.2f  %7.2f  %7.2f  %6.2f  %6.1f  %s\n",
                p.rows, p.columns, std::string(name_of(p.engine)).c_str(), std::string(name_of(p.precision)).c_str(),
                integrator_width, p.integrator.c_str(), row.threads_used, row.ns_per_particle_step,
                row.register_limit_ns, row.memory_limit_ns, row.ns_per_particle_step / row.register_limit_ns,
                row.bytes_per_particle, row.of.variant.c_str());
  out << line.data() << std::flush;
  flush_standard_output();  // which sees now, not after all rows, that nobody gets them
}

/// Time over size: a curve for each precision, number of threads and integrator, in the plain scene.
Chart throughput_chart(const std::vector<ThroughputRow>& rows, int repeats) {
  Chart chart;
  chart.title = "Time for one particle and step";
  chart.note = machine_line();
  chart.x = {"particles per side", true, false, {}};
  chart.y = {"ns, median of " + counted(repeats, "run"), false, true, {}};
  const auto add = [&](const std::string& name, const ThroughputRow& row, double y) {
    auto series = std::find_if(chart.series.begin(), chart.series.end(), [&](const auto& s) { return s.name == name; });
    if (series == chart.series.end()) {
      const auto style = series_style(dark_tokens(), int(chart.series.size()));
      series = chart.series.insert(series, {name, style, true, 3, {}, {}});
    }
    const double side = row.of.preset.rows;
    series->x.push_back(side), series->y.push_back(y);
    const auto same = [&](const PlotTick& tick) { return tick.at == side; };
    if (std::none_of(chart.x.ticks.begin(), chart.x.ticks.end(), same))
      chart.x.ticks.push_back({side, std::to_string(row.of.preset.rows)});
  };
  for (const ThroughputRow& row : rows) {
    const Preset& p = row.of.preset;
    if (!row.of.variant.empty() || row.threads_used < row.of.threads) continue;
    const std::string precision(name_of(p.precision));
    if (p.engine == EngineKind::opencl) {
      add("OpenCL, " + precision, row, row.ns_per_particle_step);
      continue;
    }
    add(p.integrator + ", " + precision + ", " + counted(row.threads_used, "thread"), row, row.ns_per_particle_step);
    if (row.threads_used == 1 && p.integrator == "verlet")
      add("arithmetic alone, " + precision, row, row.register_limit_ns);
  }
  std::erase_if(chart.series, [](const ChartSeries& series) { return series.x.size() < 2; });
  const auto smaller = [](const PlotTick& a, const PlotTick& b) { return a.at < b.at; };
  std::sort(chart.x.ticks.begin(), chart.x.ticks.end(), smaller);
  return chart;
}

int throughput(const ThroughputOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const int threads = options.threads > 0 ? options.threads : processors();
  out << machine_line() << "\nns per particle and step: the median of " << counted(options.repeats, "run")
      << ", and the limits of this machine, measured with it\n\n";
  const auto cases = throughput_cases(options.quick, threads);
  const int width = integrator_width(cases);
  print_head(out, width);
  Json json = Json::array();
  std::vector<ThroughputRow> rows;
  InterruptGuard guard;
  Progress progress("bench throughput");
  wake_processor();
  for (const ThroughputCase& which : cases) {
    if (InterruptGuard::interrupted()) break;
    rows.push_back(measure_throughput(which, options.repeats));
    progress.clear();
    print_row(out, rows.back(), width);
    json.push_back(row_json(rows.back()));
    progress.update(double(rows.size()) / double(cases.size()));
  }
  progress.clear();
  if (!options.json.empty()) write_output(options.json, json_text(bench_json("throughput", json)), bench_reach());
  if (!options.png.empty()) write_charts(options.png, {throughput_chart(rows, options.repeats)}, bench_reach());
  return bench_exit(options.outputs());
}

void print_pair(std::ostream& out, const std::array<ThroughputRow, 2>& rows) {
  const auto& [one, many] = rows;
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(), "%4d x %-4d  %10.2f  %7d  %8.2f  %6.2f  %s\n", one.of.preset.rows,
                one.of.preset.columns, one.ns_per_particle_step, many.threads_used, many.ns_per_particle_step,
                many.over_one_thread, many.of.variant.c_str());
  out << line.data() << std::flush;
  flush_standard_output();
}

int throughput_beside_load(const ThroughputOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const int busy = processors() - 1;
  out << machine_line() << "\nns per particle and step while " << counted(busy, "other thread")
      << " kept CPUs busy: the median of " << counted(options.repeats, "run")
      << ", and that of the ratios to one thread\n\n      cloth  one thread  threads    median   ratio\n";
  const auto cases =
      cases_beside_load(options.quick, options.threads > 0 ? options.threads : std::max(processors(), 2));
  Json json = Json::array();
  InterruptGuard guard;
  Progress progress("bench throughput");
  wake_processor();
  for (const ThroughputCase& which : cases) {
    if (InterruptGuard::interrupted()) break;
    const auto rows = measure_beside_load(which, busy, options.repeats);
    progress.clear();
    print_pair(out, rows);
    for (const ThroughputRow& row : rows) json.push_back(row_json(row));
    progress.update(double(json.size()) / 2 / double(cases.size()));
  }
  progress.clear();
  if (!options.json.empty()) write_output(options.json, json_text(bench_json("throughput", json)), bench_reach());
  return bench_exit(options.outputs());
}

}  // namespace

void add_bench_throughput(CLI::App& bench, Action& action) {
  CLI::App* command = bench.add_subcommand(
      "throughput", "Time for one particle and step, for sizes, integrators, precisions, threads and features");
  const auto options = std::make_shared<ThroughputOptions>();
  add_quick(*command, *options, "Fewer sizes");
  command->add_option("--repeats", options->repeats, "Runs per median (default 9; do not quote results of fewer)")
      ->type_name("N")
      ->transform(whole_number_between(1, 1000));
  add_threads(*command, *options, "Number of threads to compare with one");
  add_json(*command, *options);
  CLI::Option* png = add_png(*command, *options, "Draw time over size");
  command
      ->add_flag("--beside-load", options->beside_load,
                 "Instead compare several threads with one while all CPUs but one are kept busy")
      ->excludes(png);
  command->footer(
      "Examples: tyglab bench throughput --json throughput.json --png throughput.png\n"
      "          tyglab bench throughput --beside-load");
  command->callback([&action, options] {
    action = [options] { return options->beside_load ? throughput_beside_load(*options) : throughput(*options); };
  });
}

}  // namespace tyglab
