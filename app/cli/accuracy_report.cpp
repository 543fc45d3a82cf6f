#include "app/cli/bench_output.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "app/ui/kit/chart.h"
#include "core/analysis/machine.h"
#include "core/integrators/scheme.h"
#include "core/io/output_file.h"
#include "core/io/terminal.h"
#include "core/model/notation.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array decades{1e-2, 1e-3, 1e-4, 1e-5, 1e-6};

void flush_line(std::ostream& out, const std::string& line) {
  out << line << std::flush;
  flush_standard_output();
}

Json row_json(const AccuracyRow& row) {
  Json json = {{"scene", row.scene},
               {"engine", name_of(row.engine)},
               {"precision", name_of(row.precision)},
               {"integrator", row.integrator},
               {"dt", row.dt},
               {"steps", row.steps},
               {"force_evaluations", row.force_evaluations},
               {"seconds", row.seconds},
               {"error_rms_m", finite_or_null(row.error_rms_m)},
               {"status", name_of(row.status)}};
  if (row.tolerance) json["tolerance"] = *row.tolerance;
  if (row.unconverged > 0) json["unconverged_solves"] = row.unconverged;
  return json;
}

Json reference_json(const AccuracyResult& result) {
  const Reference& reference = result.reference;
  return {{"title", result.scene.title},
          {"rows", result.scene.preset.kind == Kind::cloth ? result.scene.preset.rows : 1},
          {"columns", result.scene.preset.kind == Kind::cloth ? result.scene.preset.columns : 1},
          {"seconds", result.scene.seconds},
          {"samples", accuracy_samples},
          {"made_by", reference.made_by},
          {"agreement_rms_m", reference.agreement_rms_m},
          {"predictable_s", reference.predictable_s},
          {"predictable_longer", reference.predictable_longer}};
}

/// When a method reaches an error, if it does and the reference can tell.
std::optional<Reached> reached_by(std::span<const AccuracyRow> method, double error, const Reference& reference) {
  return can_tell(reference, error) ? reached(method, error) : std::nullopt;
}

void add_reached(Json& list, std::span<const AccuracyRow> method, const Reference& reference) {
  for (const double error : decades)
    if (const auto at = reached_by(method, error, reference))
      list.push_back({{"scene", method.front().scene},
                      {"integrator", method.front().integrator},
                      {"precision", name_of(method.front().precision)},
                      {"engine", name_of(method.front().engine)},
                      {"error_rms_m", error},
                      {"seconds", at->seconds},
                      {"at_largest_dt", at->at_largest_dt}});
}

Json winner_json(const AccuracyWinner& winner) {
  Json json = {{"scene", winner.scene},           {"error_rms_m", winner.error_rms_m},
               {"integrator", winner.integrator}, {"precision", name_of(winner.precision)},
               {"seconds", winner.seconds},       {"at_largest_dt", winner.at_largest_dt}};
  const bool both = !winner.odeint.empty();
  json["odeint"] = both ? Json(winner.odeint) : Json(nullptr);
  json["odeint_precision"] = both ? Json(name_of(winner.odeint_precision)) : Json(nullptr);
  json["odeint_seconds"] = both ? Json(winner.odeint_seconds) : Json(nullptr);
  return json;
}

/// The curve of a method, or nothing where it has no row to show.
ChartSeries series_of(std::span<const AccuracyRow> rows, const std::string& name, CurveStyle style) {
  ChartSeries series{name, style, true, 2.5f, {}, {}};
  for (const AccuracyRow& row : rows)
    if (row.status != AccuracyStatus::diverged) {
      series.x.push_back(row.seconds), series.y.push_back(row.error_rms_m);
    }
  return series;
}

/// Boost.Odeint's methods that are drawn: those that a user would take.
struct OdeintCurve {
  const char* name;
  const char* title;
  LineStyle line;
};

const OdeintCurve* odeint_curve(std::string_view name) {
  static constexpr std::array curves{
      OdeintCurve{"odeint_runge_kutta4", "Odeint: Runge-Kutta 4", LineStyle::solid},
      OdeintCurve{"odeint_runge_kutta_dopri5_controlled", "Odeint: dopri5, controlled", LineStyle::dashed},
      OdeintCurve{"odeint_runge_kutta_fehlberg78_controlled", "Odeint: Fehlberg 7(8), controlled", LineStyle::dash_dot},
      OdeintCurve{"odeint_velocity_verlet", "Odeint: velocity Verlet", LineStyle::dotted},
      OdeintCurve{"odeint_adams_bashforth_moulton", "Odeint: Adams", LineStyle::long_dash}};
  const auto it = std::find_if(curves.begin(), curves.end(), [&](const auto& curve) { return curve.name == name; });
  return it == curves.end() ? nullptr : &*it;
}

Chart chart_of(const AccuracyResult& result) {
  Chart chart;
  chart.title = "Error over run time: " + result.scene.title;
  const std::string floor =
      result.reference.made_by.size() > 1
          ? "the references agree to " + short_number(result.reference.agreement_rms_m, 1) + " m; "
          : "against the closed form; ";
  chart.note = printed("%g s; ", result.scene.seconds) + floor + machine_line();
  chart.x = {"run time (s of processor time, one thread)", true, false, {}};
  chart.y = {"rms error of all positions (m)", true, false, {}};
  const Tokens colors = dark_tokens();
  for (const auto method : by_method(result.rows)) {
    const AccuracyRow& row = method.front();
    if (row.engine != EngineKind::cpu) continue;  // its times are of another clock
    const bool single = row.precision == Precision::float_;
    if (const OdeintCurve* curve = odeint_curve(row.integrator)) {
      const CurveStyle style{colors.vermilion, curve->line, 1.4f};
      if (!single) chart.series.push_back(series_of(method, curve->title, style));
    } else if (is_integrator(row.integrator) && (!single || row.integrator.ends_with("verlet"))) {
      // Two methods show where float's rounding ends them; it is the same for all.
      const std::string title(scheme(row.integrator).title);
      chart.series.push_back(
          series_of(method, single ? title + ", float" : title, integrator_style(colors, row.integrator)));
      chart.series.back().hollow = single;
    }
  }
  std::erase_if(chart.series, [](const ChartSeries& series) { return series.x.empty(); });
  return chart;
}

Json statistics_json(const MotionStatistics& row) {
  Json json = {{"scene", row.scene}, {"integrator", row.integrator},
               {"dt", row.dt},       {"from_s", row.from},
               {"to_s", row.to},     {"status", row.diverged ? "diverged" : "ok"}};
  if (row.diverged) return json;
  json["mean_height_m"] = row.height.mean, json["mean_height_error_m"] = row.height.error;
  json["kinetic_J"] = row.kinetic.mean, json["kinetic_error_J"] = row.kinetic.error;
  json["energy_change_over_kinetic"] = row.change;
  return json;
}

}  // namespace

void print_scene(std::ostream& out, const AccuracyResult& result) {
  const Reference& reference = result.reference;
  std::string text = "\n" + result.scene.name + ": " + result.scene.title + printed(", %g s\n", result.scene.seconds);
  for (const std::string& by : reference.made_by) text += "  reference: " + by + "\n";
  if (reference.made_by.size() > 1)
    text += "  they agree to " + short_number(reference.agreement_rms_m, 2) + " m (rms)\n";
  text += "  a perturbation of 1e-12 m stays below 1e-9 m for " + short_number(reference.predictable_s, 2) +
          (reference.predictable_longer ? " s at least\n" : " s\n");
  text += "  method                                          ";
  for (const double error : decades) text += printed("%10.0e", error);
  flush_line(out, text + "    least error\n");
}

void print_method(std::ostream& out, const std::vector<AccuracyRow>& rows, const Reference& reference) {
  if (rows.empty()) return;
  const AccuracyRow& first = rows.front();
  const std::string name = first.integrator + (first.engine == EngineKind::cpu ? "" : ", OpenCL, wall time");
  std::string text = printed("  %-41s %-6s", name.c_str(), std::string(name_of(first.precision)).c_str());
  for (const double error : decades) {
    const auto at = reached_by(rows, error, reference);
    text += at ? printed("%9.3g%s", at->seconds * 1e3, at->at_largest_dt ? "*" : " ") : printed("%10s", "- ");
  }
  const auto less = [](const AccuracyRow& a, const AccuracyRow& b) { return a.error_rms_m < b.error_rms_m; };
  const AccuracyRow& best = *std::min_element(rows.begin(), rows.end(), less);
  if (std::isfinite(best.error_rms_m))
    text +=
        printed("  %9.2g%s", best.error_rms_m, best.status == AccuracyStatus::below_floor ? " (below the floor)" : "");
  else
    text += "   diverged";
  flush_line(out, text + "\n");
}

void print_winners(std::ostream& out, const std::vector<AccuracyWinner>& winners) {
  for (const AccuracyWinner& w : winners) {
    std::string text = "  " + short_number(w.error_rms_m, 1) + " m: " + w.integrator + " (" +
                       std::string(name_of(w.precision)) + "), " + short_number(w.seconds * 1e3, 3) + " ms";
    if (w.at_largest_dt) text += ", at the largest stable dt";
    if (!w.odeint.empty())
      text += "; " + w.odeint + " (" + std::string(name_of(w.odeint_precision)) + ") " +
              short_number(w.odeint_seconds * 1e3, 3) + " ms, " + short_number(w.odeint_seconds / w.seconds, 2) +
              " times as long";
    flush_line(out, text + "\n");
  }
}

void print_statistics(std::ostream& out, const std::vector<MotionStatistics>& statistics) {
  if (statistics.empty()) return;
  const MotionStatistics& first = statistics.front();
  char line[256];
  std::snprintf(line, sizeof line,
                "\n%s, beyond what can be predicted: means from %g to %g s, ± their standard error\n%-20s %9s  %-22s  "
                "%-22s  %s\n",
                first.scene.c_str(), first.from, first.to, "integrator", "dt, s", "mean height, m", "kinetic energy, J",
                "energy change");
  out << line;
  for (const MotionStatistics& row : statistics) {
    if (row.diverged) {
      std::snprintf(line, sizeof line, "%-20s %9.3g  diverged\n", row.integrator.c_str(), row.dt);
    } else {
      std::snprintf(line, sizeof line, "%-20s %9.3g  %9.5f ± %-10.2g  %9.3e ± %-9.1e  %+.2g\n", row.integrator.c_str(),
                    row.dt, row.height.mean, row.height.error, row.kinetic.mean, row.kinetic.error, row.change);
    }
    out << line;
  }
}

Json accuracy_json(const std::vector<AccuracyResult>& results, const std::vector<MotionStatistics>& statistics) {
  Json runs = Json::array(), references = Json::object(), reached = Json::array(), summary = Json::array();
  for (const AccuracyResult& result : results) {
    for (const AccuracyRow& row : result.rows) runs.push_back(row_json(row));
    for (const auto method : by_method(result.rows)) add_reached(reached, method, result.reference);
    references[result.scene.name] = reference_json(result);
    for (const auto& winner : accuracy_winners(result.rows, result.reference)) summary.push_back(winner_json(winner));
  }
  Json json = bench_json("accuracy", std::move(runs));
  json["references"] = std::move(references);
  json["reached"] = std::move(reached);
  json["summary"] = std::move(summary);
  json["statistics"] = Json::array();
  for (const MotionStatistics& row : statistics) json["statistics"].push_back(statistics_json(row));
  return json;
}

std::vector<Chart> accuracy_charts(const std::vector<AccuracyResult>& results) {
  std::vector<Chart> charts;
  charts.reserve(results.size());
  for (const AccuracyResult& result : results) charts.push_back(chart_of(result));
  return charts;
}

}  // namespace tyglab
