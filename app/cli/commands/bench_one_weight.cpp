// `tyglab bench one-weight`: figure 3.2 of the report, with the error of every integrator.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/cli/bench_output.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/cli/preset_argument.h"
#include "app/process/interrupt.h"
#include "app/ui/kit/chart.h"
#include "core/analysis/one_weight.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

constexpr int most_steps = 1'000'000;

struct WeightOptions : BenchOptions {
  double seconds = 3;
  std::vector<std::string> settings;
};

/// The shipped preset with the settings. Throws UsageError where that is no mass on a spring, or too long a run.
Preset weight_preset(const WeightOptions& options) {
  Preset preset = load_preset(find_preset("one_weight").file);
  try {
    preset = with_settings(preset, options.settings);
  } catch (const PresetError& error) {
    throw UsageError(error.what());
  }
  if (preset.kind != Kind::one_weight)
    throw UsageError(
        "--set kind: bench one-weight measures only the mass on a spring; tyglab bench accuracy measures cloths");
  if (options.seconds / preset.dt > most_steps)
    throw UsageError("--seconds: more than " + std::to_string(most_steps) + " steps; use fewer seconds or a larger dt");
  return preset;
}

Json row_json(const WeightRun& run) {
  const Preset& p = run.preset;
  return {{"scene", "one_weight"},
          {"engine", name_of(p.engine)},
          {"precision", name_of(p.precision)},
          {"integrator", p.integrator},
          {"dt", p.dt},
          {"steps", run.t.empty() ? 0 : run.t.size() - 1},
          {"error_rms_m", run.diverged ? Json() : Json(run.error_rms_m)},
          {"error_largest_m", run.diverged ? Json() : Json(run.error_largest_m)},
          {"status", run.diverged ? "diverged" : "ok"}};
}

void print_row(std::ostream& out, const WeightRun& run) {
  std::array<char, 256> line;
  if (run.diverged)
    std::snprintf(line.data(), line.size(), "%-20s  %10s  %10s  diverged\n", run.preset.integrator.c_str(), "-", "-");
  else
    std::snprintf(line.data(), line.size(), "%-20s  %10.3g  %10.3g\n", run.preset.integrator.c_str(), run.error_rms_m,
                  run.error_largest_m);
  out << line.data() << std::flush;
  flush_standard_output();
}

/// The report's four curves in its colors: the exact motion broad, under the others.
Chart weight_chart(const std::vector<WeightRun>& runs) {
  Chart chart;
  chart.title = "Mass on a spring (figure 3.2)";
  chart.x = {"t (s)", false, true, {}};
  chart.y = {"y (m)", false, false, {}};
  const Tokens colors = dark_tokens();
  for (const char* name : {"verlet", "improved_euler", "euler"}) {
    const auto run = std::find_if(runs.begin(), runs.end(), [&](const auto& r) { return r.preset.integrator == name; });
    if (run == runs.end()) continue;
    if (chart.series.empty()) {
      chart.series.push_back({"exact", integrator_style(colors, "exact"), true, 0, run->t, run->exact});
      chart.series.back().style.width = 4.5f;
      std::array<char, 128> note;
      std::snprintf(note.data(), note.size(), "dt = %g s, ω·dt = %.3g, k_d = %g Ns/m", run->preset.dt,
                    run->preset.dt * std::sqrt(run->preset.k / run->preset.m), run->preset.k_d);
      chart.note = note.data();
    }
    chart.series.push_back({std::string(scheme(name).title), integrator_style(colors, name), true, 0, run->t, run->y});
  }
  return chart;
}

int one_weight(const WeightOptions& options) {
  const Preset preset = weight_preset(options);
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const int steps = std::max(1, int(std::lround(options.seconds / preset.dt)));
  std::array<char, 256> head;
  std::snprintf(head.data(), head.size(),
                "Mass on a spring for %s of dt = %g s, against its closed form: m = %g kg, k = %g N/m, "
                "k_d = %g Ns/m\n\nintegrator               rms, m  largest, m\n",
                counted(steps, "step").c_str(), preset.dt, preset.m, preset.k, preset.k_d);
  out << head.data() << std::flush;
  Json json = Json::array();
  std::vector<WeightRun> runs;
  InterruptGuard guard;
  for (const Scheme& scheme : schemes()) {
    Preset with = preset;
    with.integrator = scheme.name;
    WeightRun run = run_weight(with, steps, InterruptGuard::interrupted);
    if (InterruptGuard::interrupted()) break;
    print_row(out, run);
    json.push_back(row_json(run));
    runs.push_back(std::move(run));
  }
  if (!options.json.empty()) write_output(options.json, json_text(bench_json("one-weight", json)), bench_reach());
  if (!options.png.empty()) write_charts(options.png, {weight_chart(runs)}, bench_reach());
  return bench_exit(options.outputs());
}

}  // namespace

void add_bench_one_weight(CLI::App& bench, Action& action) {
  CLI::App* command =
      bench.add_subcommand("one-weight", "Figure 3.2: the mass on a spring, every integrator against the exact motion");
  const auto options = std::make_shared<WeightOptions>();
  command->add_option("--seconds", options->seconds, "Simulated time, s (default 3)")
      ->type_name("T")
      ->transform(number_between(1e-6, 1e4, "s"));
  command
      ->add_option("--set", options->settings, "Set a constant of the preset one_weight, such as k_d=0.2 or dt=0.005")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->allow_extra_args(false)
      ->take_all();
  add_json(*command, *options, "Write the errors for programs");
  add_png(*command, *options, "Draw the report's four curves");
  command->footer("Example: tyglab bench one-weight --set k_d=0.1 --png figure_3_2.png");
  command->callback([&action, options] { action = [options] { return one_weight(*options); }; });
}

}  // namespace tyglab
