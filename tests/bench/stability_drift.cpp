// `tyglab stability drift`: the energy of every method over a long run without damping.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/cli/bench_output.h"
#include "app/cli/command_line.h"
#include "app/cli/commands/commands.h"
#include "app/cli/outputs.h"
#include "app/process/interrupt.h"
#include "app/ui/kit/chart.h"
#include "core/analysis/machine.h"
#include "core/analysis/study_run.h"
#include "core/io/output_file.h"
#include "tests/bench/drift.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

Json row_json(const DriftRow& row) {
  const Preset& p = row.of.preset;
  return {{"scene", row.of.scene},
          {"integrator", p.integrator},
          {"rows", p.rows},
          {"columns", p.columns},
          {"k_s", p.k_s},
          {"dt", p.dt},
          {"dt_over_verlet_limit", row.of.part_of_limit},
          {"steps", row.of.steps},
          {"status", row.diverged_at > 0 ? "diverged" : "ok"},
          {"diverged_at_step", row.diverged_at > 0 ? Json(row.diverged_at) : Json(nullptr)},
          {"energy_of_motion_J", row.motion},
          {"lowest_J", row.lowest},
          {"highest_J", row.highest},
          {"trend_over_motion", row.diverged_at > 0 ? Json(nullptr) : Json(row.trend)},
          {"trend_standard_error", row.diverged_at > 0 ? Json(nullptr) : Json(row.trend_error)},
          {"unconverged_solves", row.unconverged},
          {"t_s", row.t},
          {"energy_less_start_J", row.energy}};
}

void print_row(std::ostream& out, const DriftRow& row) {
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(),
                row.diverged_at > 0 ? "%-12s  %-20s  %6.3f  %9.3g  %9.3g  %9.3g          -         -  "
                                    : "%-12s  %-20s  %6.3f  %9.3g  %9.3g  %9.3g  %+9.2g  %8.1g  ",
                row.of.scene.c_str(), row.of.preset.integrator.c_str(), row.of.part_of_limit, row.motion, row.lowest,
                row.highest, row.trend, row.trend_error);
  out << line.data()
      << (row.diverged_at > 0 ? "diverged in step " + std::to_string(row.diverged_at) : std::string("bounded")) << '\n'
      << std::flush;
  flush_standard_output();
}

std::string name_of(const DriftRow& row) {
  if (row.of.part_of_limit == 0.5) return row.of.preset.integrator;
  std::array<char, 32> part;
  std::snprintf(part.data(), part.size(), " at %g", row.of.part_of_limit);
  return row.of.preset.integrator + part.data();
}

/// Energy over time of a scene, in parts of the motion's: as far as it stays within the scale, or what it rises by on a
/// logarithmic one.
Chart drift_chart(const std::vector<DriftRow>& rows, const std::string& scene, bool rise) {
  constexpr double shown = 1.2;
  Chart chart;
  chart.title = scene == "taut_sheet" ? "Energy on the taut sheet"
                : rise                ? "Rise of the energy on the slack sheet"
                                      : "Energy on the slack sheet";
  chart.note = machine_line();
  chart.x = {"steps", false, true, {}};
  chart.y = {"energy minus that at the start, over that of the motion", rise, false, {}};
  for (const DriftRow& row : rows) {
    if (row.of.scene != scene || row.diverged_at > 0) continue;
    ChartSeries series{name_of(row), integrator_style(dark_tokens(), row.of.preset.integrator), true, 0, {}, {}};
    if (row.of.part_of_limit != 0.5) series.style.width = 0.9f;
    for (std::size_t n = 1; n < row.t.size(); ++n) {
      const double part = row.energy[n] / row.motion;
      if (!rise && std::abs(part) > shown) break;
      series.x.push_back(row.t[n] / row.of.preset.dt), series.y.push_back(part);
    }
    const bool visible = !rise || std::any_of(series.y.begin(), series.y.end(), [](double y) { return y > 0; });
    if (series.x.size() > 1 && visible) chart.series.push_back(series);
  }
  return chart;
}

int drift(const BenchOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const std::vector<DriftCase> cases = drift_cases(options.quick);
  const Preset& first = cases.front().preset;
  out << machine_line() << "\n"
      << cases.front().steps << " steps without damping, " << first.rows << " x " << first.columns
      << ", double. dt is given over the limit of Verlet.\nEnergy minus that at the start, J: lowest and "
      << "highest; then its trend over all steps as a fraction of the motion's energy,\nand the standard error of the "
         "trend\n\n"
      << "scene         integrator                dt     motion     lowest    highest      trend     error\n"
      << std::flush;
  std::vector<DriftRow> rows(cases.size());
  int reported = 0;
  InterruptGuard guard;
  Progress progress("stability drift");
  in_parallel(
      int(cases.size()), options.threads > 0 ? options.threads : processors(),
      [&](int n) { rows[std::size_t(n)] = measure_drift(cases[std::size_t(n)], InterruptGuard::interrupted); },
      [&](int n) {
        if (InterruptGuard::interrupted()) return;  // it may have been cut short
        progress.clear();
        print_row(out, rows[std::size_t(n)]);
        progress.update(double(++reported) / double(cases.size()));
      },
      InterruptGuard::interrupted);
  rows.resize(std::size_t(reported));
  progress.clear();
  if (!options.json.empty()) {
    Json json = Json::array();
    for (const DriftRow& row : rows) json.push_back(row_json(row));
    write_output(options.json, json_text(bench_json("stability drift", json)), bench_reach());
  }
  if (!options.png.empty())
    write_charts(options.png,
                 {drift_chart(rows, "taut_sheet", false), drift_chart(rows, "slack_sheet", false),
                  drift_chart(rows, "slack_sheet", true)},
                 bench_reach());
  return bench_exit(options.outputs());
}

}  // namespace

void add_stability_drift(CLI::App& stability, Action& action) {
  CLI::App* command =
      stability.add_subcommand("drift", "How well every method conserves energy over a million steps without damping");
  const auto options = std::make_shared<BenchOptions>();
  add_quick(*command, *options, "20,000 steps");
  add_threads(*command, *options, "Simultaneous runs");
  add_json(*command, *options);
  add_png(*command, *options, "Draw energy over time");
  command->footer("Example: tyglab stability drift --json drift.json --png drift.png");
  command->callback([&action, options] { action = [options] { return drift(*options); }; });
}

}  // namespace tyglab
