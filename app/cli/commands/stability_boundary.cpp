// `tyglab stability boundary`: the stability limits of dt and k_s for each explicit method, predicted and measured.
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
#include "core/analysis/boundary.h"
#include "core/analysis/machine.h"
#include "core/analysis/study_run.h"
#include "core/io/output_file.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

enum class What { dt, k_s, growth, slack };

/// One kind of measurement: its rows and what they are called.
struct Part {
  What what;
  const std::vector<Preset>& cases;
  const char* title;
  const char* head;
  double within;  ///< of its prediction; 0: not checked
};

Json row_json(const BoundaryRow& row, What what, const BoundaryCases& cases) {
  const Preset& p = row.preset;
  Json json = {{"scene", what == What::slack ? "hanging" : "taut_sheet"}, {"integrator", p.integrator}};
  if (what != What::k_s) json["k_s"] = p.k_s;
  if (what == What::k_s || what == What::growth) json["dt"] = p.dt;
  json["k_d"] = p.k_d;
  const std::string quantity = what == What::k_s ? "k_s" : what == What::growth ? "growth_per_step" : "dt";
  json[quantity + "_predicted"] = finite_or_null(row.predicted);
  json[quantity + "_measured"] = finite_or_null(row.measured);
  json["ratio"] = finite_or_null(row.ratio());
  json["rows"] = p.rows, json["columns"] = p.columns;
  if (what != What::slack) return json;
  json["dt_any_configuration"] = row.any_configuration;
  json["steps"] = cases.slack_steps;
  json["criterion"] = "diverged within these steps";
  return json;
}

void print_row(std::ostream& out, const BoundaryRow& row, What what) {
  const Preset& p = row.preset;
  const double given = what == What::k_s || what == What::growth ? p.dt : p.k_s;
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(), "%4d x %-4d  %-20s  %8.3g  %8.3g  %11.5g  %11.5g  %7.4f", p.rows, p.columns,
                p.integrator.c_str(), given, p.k_d, row.predicted, row.measured, row.ratio());
  out << line.data();
  if (what == What::slack) {
    std::snprintf(line.data(), line.size(), "  %11.5g", row.any_configuration);
    out << line.data();
  }
  out << '\n' << std::flush;
  flush_standard_output();  // which sees now, not after all rows, that nobody gets them
}

BoundaryRow measure(const Preset& preset, What what, const BoundaryCases& cases) {
  switch (what) {
    case What::dt:
      return measure_dt(preset);
    case What::k_s:
      return measure_k_s(preset);
    case What::growth:
      return measure_growth(preset);
    case What::slack:
      break;
  }
  return measure_slack(preset, cases.slack_steps);
}

/// dt over k_s on the largest sheet, damped or not: a line a method as predicted, and discs as measured. In units of
/// √(m/k_s), in which it does not depend on k_s.
Chart boundary_chart(const std::vector<BoundaryRow>& rows, bool damped) {
  Chart chart;
  chart.title = damped ? "Where methods become unstable, fastest wave damped with ζ = 0.1"
                       : "Where methods become unstable, undamped";
  chart.note = machine_line();
  chart.x = {"k_s, N/m", true, false, {}};
  chart.y = {"dt from which it is unstable, in units of √(m/k_s)", false, true, {}};
  int side = 0;
  for (const BoundaryRow& row : rows) side = std::max(side, row.preset.rows);
  ChartSeries measured{"measured", {dark_tokens().text, LineStyle::solid, 1.8f}, false, 3, {}, {}};
  for (const BoundaryRow& row : rows) {
    const Preset& p = row.preset;
    if (p.rows != side || (p.k_d > 0) != damped) continue;
    const double unit = std::sqrt(p.m / p.k_s);
    auto series =
        std::find_if(chart.series.begin(), chart.series.end(), [&](const auto& s) { return s.name == p.integrator; });
    if (series == chart.series.end()) {
      const auto style = integrator_style(dark_tokens(), p.integrator);
      series = chart.series.insert(series, {p.integrator, style, true, 0, {}, {}});
    }
    series->x.push_back(p.k_s), series->y.push_back(row.predicted / unit);
    measured.x.push_back(p.k_s), measured.y.push_back(row.measured / unit);
  }
  chart.series.push_back(measured);
  return chart;
}

/// Measures a part's cases on all threads and tells each. Whether all were within what is expected.
bool measure_part(const Part& part, const BoundaryCases& cases, int threads, std::ostream& out, Progress& progress,
                  std::vector<BoundaryRow>& rows) {
  out << '\n' << part.title << "\n      cloth  integrator            " << part.head << '\n' << std::flush;
  rows.resize(part.cases.size());
  int reported = 0;
  bool kept = true;
  in_parallel(
      int(part.cases.size()), threads,
      [&](int n) { rows[std::size_t(n)] = measure(part.cases[std::size_t(n)], part.what, cases); },
      [&](int n) {
        const BoundaryRow& row = rows[std::size_t(n)];
        progress.clear();
        print_row(out, row, part.what);
        kept &= part.within == 0 || std::abs(row.ratio() - 1) <= part.within;
        progress.update(double(++reported) / double(rows.size()));
      },
      InterruptGuard::interrupted);
  rows.resize(std::size_t(reported));
  return kept;
}

int boundary(const BenchOptions& options) {
  check_outputs(options.outputs());
  std::ostream& out = people(options.outputs());
  const BoundaryCases cases = boundary_cases(options.quick);
  const int threads = options.threads > 0 ? options.threads : processors();
  const std::string slack_title = "A slack cloth: dt from which it diverges within " +
                                  std::to_string(cases.slack_steps) +
                                  " steps, and the limits as it hangs and for any configuration";
  // dt's limit goes with 1/√k_s: what is within 1 % in dt is so within 2 % in k_s.
  const Part parts[] = {
      {What::dt, cases.dt, "Taut sheet: dt from which a method is unstable, s",
       "     k_s       k_d    predicted     measured    ratio", 0.01},
      {What::k_s, cases.k_s, "Taut sheet: k_s from which a method is unstable, N/m",
       "      dt       k_d    predicted     measured    ratio", 0.02},
      {What::growth, cases.growth,
       "Taut sheet: growth per step (natural logarithm) of methods that are unstable at every dt",
       "      dt       k_d    predicted     measured    ratio", 0.05},
      {What::slack, cases.slack, slack_title.c_str(), "     k_s       k_d    as it hangs  measured    ratio  any", 0},
  };
  out << machine_line() << "\nUnstable: a perturbation of 1e-9 m grows 1e5-fold within 4000 steps, in double\n";
  Json lists[std::size(parts)];
  std::vector<BoundaryRow> dt_rows;
  InterruptGuard guard;
  Progress progress("stability boundary");
  bool kept = true;
  for (std::size_t n = 0; n < std::size(parts) && !InterruptGuard::interrupted(); ++n) {
    std::vector<BoundaryRow> rows;
    kept &= measure_part(parts[n], cases, threads, out, progress, rows);
    lists[n] = Json::array();
    for (const BoundaryRow& row : rows) lists[n].push_back(row_json(row, parts[n].what, cases));
    if (parts[n].what == What::dt) dt_rows = rows;
  }
  progress.clear();
  if (!options.json.empty()) {
    Json all = bench_json("stability boundary", lists[0]);
    all["k_s_runs"] = lists[1], all["growth_runs"] = lists[2], all["slack_runs"] = lists[3];
    write_output(options.json, json_text(all), bench_reach());
  }
  if (!options.png.empty())
    write_charts(options.png, {boundary_chart(dt_rows, false), boundary_chart(dt_rows, true)}, bench_reach());
  if (const int code = bench_exit(options.outputs()); code != exit_done) return code;
  if (kept) return exit_done;
  std::cerr
      << "tyglab: a method did not become unstable where predicted (dt 1 %, k_s 2 %, growth 5 %); see the ratios.\n";
  return exit_violation;
}

}  // namespace

void add_stability_boundary(CLI::App& stability, Action& action) {
  CLI::App* command = stability.add_subcommand(
      "boundary", "The dt and the k_s at which every explicit method becomes unstable, predicted and measured");
  const auto options = std::make_shared<BenchOptions>();
  add_quick(*command, *options, "Fewer sizes and stiffnesses");
  add_threads(*command, *options, "Simultaneous measurements");
  add_json(*command, *options);
  add_png(*command, *options, "Draw the boundaries over k_s");
  command->footer("Example: tyglab stability boundary --json boundary.json --png boundary.png");
  command->callback([&action, options] { action = [options] { return boundary(*options); }; });
}

}  // namespace tyglab
