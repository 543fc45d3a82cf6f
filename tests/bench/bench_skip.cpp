// `tyglab bench skip`: the cost of each feature when on, off, and absent.
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <memory>
#include <optional>

#include "app/base/settings.h"
#include "app/cli/bench_output.h"
#include "app/cli/command_line.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/process/interrupt.h"
#include "app/ui/kit/chart.h"
#include "core/analysis/machine.h"
#include "core/analysis/study_run.h"
#include "core/io/output_file.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "tests/bench/instructions.h"
#include "tests/bench/skip.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array all_states{SkipState::absent, SkipState::off, SkipState::on};

struct SkipOptions : BenchOptions {
  std::string only;  ///< "wind:off"; empty: everything
  int side = 128;
  int steps = 1000;  ///< with `only`
  Precision precision = Precision::float_;
};

/// Instructions per particle and step of one feature; empty where they could not be counted. As all_states.
using Counts = std::array<std::optional<double>, all_states.size()>;

Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json row_json(const SkipRow& row, const Counts& counts) {
  return {{"feature", row.feature.name},
          {"on_means", row.feature.on_means},
          {"rows", row.feature.preset_on.rows},
          {"columns", row.feature.preset_on.columns},
          {"precision", name_of(row.feature.preset_on.precision)},
          {"rounds", row.rounds},
          {"ns_off", row.ns_off},
          {"ns_absent", row.ns_absent},
          {"ns_on", row.ns_on},
          {"instructions_off", number_or_null(counts[1])},
          {"instructions_absent", number_or_null(counts[0])},
          {"instructions_on", number_or_null(counts[2])}};
}

void print_row(std::ostream& out, const SkipRow& row, const Counts& counts) {
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(), "%-8s %7.2f %7.2f %7.2f  %+6.1f %%  %+6.2f", row.feature.name.c_str(),
                row.ns_absent, row.ns_off, row.ns_on, 100 * (row.ns_off / row.ns_absent - 1), row.ns_on - row.ns_off);
  out << line.data();
  if (counts[0] && counts[1] && counts[2]) {
    std::snprintf(line.data(), line.size(), "   %7.2f %7.2f %7.2f  %+6.2f %%", *counts[0], *counts[1], *counts[2],
                  100 * (*counts[1] / *counts[0] - 1));
    out << line.data();
  }
  out << "   " << row.feature.on_means << '\n' << std::flush;
  flush_standard_output();
}

/// Counts a feature in all states, side by side: what runs at the same time does not change a count.
Counts count(const InstructionCounter& counter, const std::string& feature, int threads) {
  Counts counts;
  const auto work = [&](int n) {
    const auto at = std::size_t(n);
    counts[at] = counter.per_particle_step({feature, all_states[at], Precision::float_});
  };
  in_parallel(
      int(all_states.size()), threads, work, [](int) {}, InterruptGuard::interrupted);
  return counts;
}

void print_head(std::ostream& out, const SkipOptions& options, const std::string& counted_with) {
  out << machine_line() << "\nThe default cloth at " << options.side << " x " << options.side
      << ", float, one thread. ns per particle and step: in an engine compiled without the feature (absent),\nwith the "
         "feature off, and on; then what it costs while it is off, and on (ns more)."
      << (counted_with.empty()
              ? "\nInstructions are not counted, since valgrind is missing: apt-get install valgrind\n\n"
              : "\nThen instructions per particle and step, at 64 x 64, " + counted_with + "\n\n")
      << "feature   absent     off      on       off      on"
      << (counted_with.empty() ? "" : "    absent     off      on       off") << "   on means\n"
      << std::flush;
}

/// A line a feature, a disc for each state.
Chart skip_chart(const std::vector<SkipRow>& rows, int side) {
  Chart chart;
  chart.title = "What a feature costs: not compiled in, off, on";
  chart.note = machine_line();
  const std::string cloth = std::to_string(side) + " x " + std::to_string(side);
  chart.x = {"ns per particle and step, " + cloth + ", float, one thread", false, true, {}};
  const Tokens colors = dark_tokens();
  chart.series = {{"absent", {colors.quiet, LineStyle::solid, 1.8f}, false, 7, {}, {}},
                  {"off", {colors.blue, LineStyle::solid, 1.8f}, false, 4, {}, {}},
                  {"on", {colors.orange, LineStyle::solid, 1.8f}, false, 5, {}, {}}};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const double line = double(rows.size() - 1 - k);  // the first on top
    chart.y.ticks.insert(chart.y.ticks.begin(), {line, rows[k].feature.name});
    const double values[] = {rows[k].ns_absent, rows[k].ns_off, rows[k].ns_on};
    for (std::size_t s = 0; s < 3; ++s) chart.series[s].x.push_back(values[s]), chart.series[s].y.push_back(line);
  }
  return chart;
}

int skip(const SkipOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const InstructionCounter counter(program_file());
  const std::string counted_with = counter.instruction_set();
  print_head(out, options, counted_with);
  const auto features = skip_features(options.side);
  Json json = Json::array();
  std::vector<SkipRow> rows;
  InterruptGuard guard;
  Progress progress("bench skip");
  for (const SkipFeature& feature : features) {
    if (InterruptGuard::interrupted()) break;
    const SkipRow row = measure_skip(feature, options.quick ? 41 : 201);
    const Counts counts = counted_with.empty() ? Counts() : count(counter, feature.name, processors());
    progress.clear();
    print_row(out, row, counts);
    json.push_back(row_json(row, counts));
    rows.push_back(row);
    progress.update(double(rows.size()) / double(features.size()));
  }
  progress.clear();
  if (!options.json.empty()) {
    Json all = bench_json("skip", json);
    all["instructions_counted_with"] = counted_with.empty() ? Json(nullptr) : Json(counted_with);
    write_output(options.json, json_text(all), bench_reach());
  }
  if (!options.png.empty()) write_charts(options.png, {skip_chart(rows, options.side)}, bench_reach());
  return bench_exit(options.outputs());
}

/// The feature and the state that "wind:off" names. Throws UsageError.
std::pair<SkipFeature, SkipState> only_of(const SkipOptions& options) {
  const auto colon = options.only.find(':');
  const std::string name = options.only.substr(0, colon);
  const std::string state = colon == std::string::npos ? "" : options.only.substr(colon + 1);
  std::vector<SkipFeature> features = skip_features(options.side);
  for (SkipFeature& feature : features) {
    if (feature.name != name) continue;
    for (const SkipState which : all_states)
      if (name_of(which) == state) return {std::move(feature), which};
    throw UsageError("--only " + options.only + ": write on, off or absent after the colon, such as " + name + ":off");
  }
  throw UsageError("--only " + options.only +
                   ": there is no such feature; known: " + joined(features, ", ", &SkipFeature::name));
}

int only(const SkipOptions& options) {
  check_outputs(options.outputs());
  auto [feature, state] = only_of(options);
  if (state == SkipState::absent && options.precision != Precision::float_)
    throw UsageError("--only " + options.only + ": engines without a feature are compiled only in float");
  feature.preset_on.precision = feature.preset_off.precision = options.precision;
  SkipCase which(feature, state);
  const double ns = which.advance(options.steps);
  people(options.outputs()) << options.only << ", " << options.side << " x " << options.side << ", "
                            << name_of(options.precision) << ", " << which.engine_name() << ": "
                            << counted(options.steps, "step") << ", " << ns << " ns per particle and step\n";
  if (!options.json.empty()) {
    const Json row = {{"feature", feature.name},   {"state", name_of(state)}, {"rows", options.side},
                      {"columns", options.side},   {"steps", options.steps},  {"precision", name_of(options.precision)},
                      {"ns_per_particle_step", ns}};
    write_output(options.json, json_text(bench_json("skip", Json::array({row}))));
  }
  return exit_done;
}

}  // namespace

void add_bench_skip(CLI::App& bench, Action& action) {
  CLI::App* command = bench.add_subcommand(
      "skip", "Cost of every feature when it is on, when it is off, and in an engine compiled without it");
  const auto options = std::make_shared<SkipOptions>();
  add_quick(*command, *options, "Fewer rounds");
  command->add_option("--side", options->side, "Particles per side of the cloth (default 128)")
      ->type_name("N")
      ->transform(whole_number_between(2, 4096));
  CLI::Option* one =
      command->add_option("--only", options->only, "Run one case once, for profilers: a feature and on, off or absent")
          ->type_name("FEATURE:STATE");
  command->add_option("--steps", options->steps, "With --only: number of steps (default 1000)")
      ->type_name("N")
      ->transform(whole_number_between(1, 1000000000))
      ->needs(one);
  command
      ->add_option_function<std::string>(
          "--precision",
          [options](const std::string& name) {
            options->precision = name == "double" ? Precision::double_ : Precision::float_;
          },
          "With --only: float (default) or double")
      ->check(CLI::IsMember({"float", "double"}).description(""))
      ->type_name("float|double")
      ->needs(one);
  add_json(*command, *options);
  add_png(*command, *options, "Draw the cost of each feature")->excludes(one);
  command->footer(
      "Examples: tyglab bench skip --json skip.json\n"
      "          valgrind --tool=callgrind tyglab bench skip --only wind:off --steps 200");
  command->callback(
      [&action, options] { action = [options] { return options->only.empty() ? skip(*options) : only(*options); }; });
}

}  // namespace tyglab
