#include "app/ui/cards/cards.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "app/base/text.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/model/effect.h"
#include "core/model/words.h"
#include "core/theory/modes.h"

namespace tyglab {
namespace {

constexpr const char* stability_heading = card_name::stability;
constexpr const char* accuracy_heading = card_name::accuracy;
// Pixels at scale 1.
constexpr float chart_at_1 = 210, words_at_1 = 40, convergence_words_at_1 = 62;
constexpr float ways_room_at_1 = 9, under_ways_at_1 = 8;
constexpr const char* accuracy_way_names[] = {"Errors", "Convergence", "Find settings"};

/// Of the choice between the card's sides with the gap under it, px; it takes as many rows as it needs.
float ways_height(const Ui& ui, float width) {
  return segments_size(ui, accuracy_way_names, 3, ways_room_at_1, width).y + ui.theme.px(under_ways_at_1);
}

/// Words over a chart, in what the card's height leaves.
void words_and_chart(Ui& ui, float height, const std::string& words, const Chart* chart, float room_at_1 = words_at_1) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float width = card_width(ui);
  const ImFont& font = *ui.fonts.small;
  const std::string lines = in_lines(font, words, width);
  const float tall = font.CalcTextSizeA(font.FontSize, 1e9f, 0, lines.c_str()).y + ui.theme.px(6);
  const float line = std::max(ui.theme.px(room_at_1), tall);
  draw_text(*ImGui::GetWindowDrawList(), font, lo, ui.theme.colors.text, lines);
  ImGui::Dummy({width, line});
  const float rest = height - ui.theme.px(card::head + card::foot) - line;
  if (chart == nullptr || rest < ui.theme.px(100)) return;
  draw_chart({*ImGui::GetWindowDrawList(), ui.theme, ui.fonts}, {lo.x, lo.y + line}, {width, rest}, *chart);
  ImGui::Dummy({width, rest});
}

/// A vertical line from the chart's foot to its head.
ChartSeries mark_at(const std::string& name, double x, ImU32 color, LineStyle line, double lo, double hi) {
  return {name, {color, line, 1.6f}, true, 0, {x, x}, {lo, hi}};
}

std::string region_sentence(const StabilityRegion& region) {
  const Spectrum& of = region.bounds;
  return "Inner steps of up to " + quantity(region.h, "s", 2) + " have " + std::to_string(region.stages) +
         " stages: damping takes hλ to −" + power_number(rounded(of.radius, 2)) +
         (of.circle <= of.radius ? ", oscillations stay in the half circle." : ", oscillations are nearly undamped.");
}

/// ω·dt in as many digits as tell it from its limit, which is said where they are close: "2.003, above 2".
std::string beside_limit(double h, double limit) {
  if (!(limit > 0) || !(h / limit > 0.9 && h / limit < 1.1)) return short_number(h, 3);
  int digits = 3;
  while (digits < 7 && h != limit && short_number(h, digits) == short_number(limit, digits)) ++digits;
  return short_number(h, digits) + (h > limit ? ", above the limit " : ", within the limit ") +
         short_number(limit, digits);
}

std::string stability_sentence(const StabilityLimits& limits) {
  const Scheme& method = scheme(limits.of.integrator);
  if (projects(method)) return "XPBD projects positions: linear theory does not cover it.";
  if (counts_passes(method))
    return std::string(method.title) + " stops after " + std::to_string(limits.of.iterations) +
           (limits.of.iterations == 1 ? " pass" : " passes") + ": linear theory does not cover their residual.";
  if (limits.region) return region_sentence(*limits.region);
  if (chooses_steps(method)) return "This method keeps its inner steps stable, as far as dt allows.";
  const double h = limits.fastest.omega() * limits.of.dt;
  const double zeta = limits.fastest.stiffness > 0 ? limits.fastest.damping / (2 * limits.fastest.omega()) : 0;
  const double radius = spectral_radius(amplification(method, h, zeta));
  const std::string of = limits.at_start ? "At the start, the fastest mode has ω·dt = "
                         : limits.now    ? "The fastest mode now has ω·dt = "
                                         : "The fastest possible mode has ω·dt = ";
  const std::string by = short_number(rounded(100 * std::abs(radius - 1), 2)) + " % per step.";
  return of + beside_limit(h, dt_crit(method, std::span(&limits.fastest, 1)) * limits.fastest.omega()) +
         (radius >= 2         ? ": oscillations grow " + power_number(rounded(radius, 3)) + "-fold per step."
          : radius > 1 + 1e-9 ? ": oscillations grow by " + by
          : radius < 1 - 1e-9 ? ": oscillations shrink by " + by
                              : ": oscillations keep their size.");
}

/// A sentence after the others, where less of the motion is compared than usual.
std::string why_short(const AccuracyStudy& study) {
  if (study.reference.seconds > 0.8 * AccuracyWatch::window) return {};
  const Preset& of = study.of;
  const std::string what = of.kind == Kind::one_weight
                               ? "a spring this stiff"
                               : std::to_string(of.rows) + " × " + std::to_string(of.columns) + " particles";
  return " The time is this short because fine runs of " + what + " would take too long.";
}

}  // namespace

Chart stability_chart(const Tokens& c, const StabilityLimits& limits) {
  const Scheme& method = scheme(limits.of.integrator);
  const double dt = limits.of.dt, now = limits.fastest.omega() * dt, bound = any_configuration(limits.of).omega() * dt;
  Chart chart;
  chart.padding = 0;
  chart.x.title = "ω·dt", chart.y.title = "growth per step (spectral radius)";
  chart.x.from_zero = true;
  double least = 1, most = 0, hi = 1;
  const auto curve = [&](const std::string& name, const CurveStyle& style, const GrowthCurve& of) {
    ChartSeries series{name, style, true, 0, of.h, of.radius};
    for (const double radius : of.radius) least = std::min(least, radius), hi = std::max(hi, radius);
    if (!of.h.empty()) most = std::max(most, of.h.back());
    chart.series.push_back(std::move(series));
  };
  const bool damped = !limits.undamped.h.empty();
  curve(std::string(method.title) + (damped ? ", damped" : ""), integrator_style(c, method.name), limits.damped);
  if (damped) curve("undamped", {c.quiet, LineStyle::dotted, 1.8f}, limits.undamped);
  most = std::max({most, now, bound});
  constexpr double flattest = 0.02;  // growth that the axis spans at least: a line at 1 is no news of its last digits
  if (hi - least < flattest) least = hi - flattest;
  chart.series.push_back({"", {c.quiet, LineStyle::solid, 1}, true, 0, {0, most}, {1, 1}});
  if (limits.now) chart.series.push_back(mark_at("this cloth", now, c.text, LineStyle::solid, least, hi));
  chart.series.push_back(mark_at("worst case", bound, c.warning, LineStyle::dashed, least, hi));
  return chart;
}

Chart region_chart(const Tokens& c, const StabilityRegion& region) {
  Chart chart;
  chart.padding = 0;
  chart.x.title = "Re hλ", chart.y.title = "Im hλ";
  const CurveStyle style = integrator_style(c, "rkc2");
  chart.series.push_back(
      {"stable with " + std::to_string(region.stages) + " stages", style, true, 0, region.x, region.y});
  ChartSeries bounds{"any shape", {c.text, LineStyle::dashed, 1.6f}, true, 0, {}, {}};
  const Spectrum& of = region.bounds;
  constexpr int points = 60;
  bounds.x.push_back(-of.radius), bounds.y.push_back(0);
  if (std::isfinite(of.circle) && of.circle > 0)
    for (int n = 0; n <= points; ++n) {
      const double x = -std::min(of.radius, 2 * of.circle) * (points - n) / points;
      const double y = std::sqrt(std::max(-x * (2 * of.circle + x), 0.0));
      if (std::hypot(x, y) <= of.fastest) bounds.x.push_back(x), bounds.y.push_back(y);
    }
  else
    bounds.x.push_back(0), bounds.y.push_back(of.fastest);
  chart.series.push_back(std::move(bounds));
  return chart;
}

std::string accuracy_time(const AccuracyStudy& study) {
  if (!study.present) return {};
  return "over the next " + quantity(study.reference.seconds, "s", 2);
}

std::string accuracy_words(const AccuracyStudy& study) {
  if (!study.problem.empty()) return "There is no reference to compare with: " + study.problem + ".";
  const ErrorPoint& now = *study.present;
  const std::string over = " over the next " + quantity(study.reference.seconds, "s", 2) +
                           " from t = " + time_number(study.at.t, now.dt) + " s";
  const std::string short_time = why_short(study);
  const std::string method(scheme(now.integrator).title);
  if (!chooses_steps(scheme(now.integrator)) && now.dt < 0.9 * study.of.dt)
    return "The reference covers only " + quantity(study.reference.seconds, "s", 2) +
           " of this cloth: too short to measure the error at dt = " + quantity(study.of.dt, "s") + ".";
  if (!std::isfinite(now.error_rms_m))
    return "With the present settings, " + method + " diverges" + over + "." + short_time;
  const double floor = reference_margin * study.reference.agreement_rms_m;
  const std::string error =
      now.resolved ? quantity(now.error_rms_m, "m", 2) : "below " + quantity(std::max(floor, now.error_rms_m), "m", 2);
  return method + "'s error is " + error + " (rms)" + over + "; it takes " + quantity(now.cost, "s", 2) +
         " of CPU time per simulated second." + short_time;
}

std::string measuring_words(const AccuracyStudy& study, double elapsed) {
  const Preset& of = study.of;
  std::string words = "Measuring the error of " + std::string(scheme(of.integrator).title);
  if (!chooses_steps(scheme(of.integrator))) words += " at dt = " + quantity(of.dt, "s");
  if (study.reference.seconds > 0) words += " over the next " + quantity(study.reference.seconds, "s", 2);
  const double part = study.reference_part;
  if (part >= 1) return words + ". The fine runs for comparison are done; the run with these settings follows.";
  words += ". First come two fine runs for comparison: " + std::to_string(int(100 * part)) + " % done";
  constexpr double telling = 0.05;  // before that, the time so far says little
  if (part < telling) return words + "; this usually takes a few seconds.";
  const double left = elapsed * (1 - part) / part;
  return words + (left < 1 ? ", less than 1 s left." : ", about " + short_number(std::ceil(left), 3) + " s left.");
}

std::string other_methods_words(const AccuracyStudy& study) {
  if (study.done || !study.present) return {};
  return " Other methods: " + std::to_string(study.methods_done) + " of " + std::to_string(AccuracyWatch::methods) +
         " measured.";
}

Chart accuracy_chart(const Tokens& c, const AccuracyStudy& study, std::optional<double> target) {
  Chart chart;
  chart.padding = 0;
  chart.x.title = "CPU seconds per simulated second", chart.x.log = true;
  chart.y.title = "error, m (rms)", chart.y.log = true;
  const auto put = [](ChartSeries& series, const ErrorPoint& point) {
    if (std::isfinite(point.error_rms_m) && point.error_rms_m > 0 && point.resolved)
      series.x.push_back(point.cost), series.y.push_back(point.error_rms_m);
  };
  for (std::size_t n = 0; n < study.points.size();) {
    const std::string& name = study.points[n].integrator;
    ChartSeries series{std::string(scheme(name).title), integrator_style(c, name), true, 2.5f, {}, {}};
    for (; n < study.points.size() && study.points[n].integrator == name; ++n) put(series, study.points[n]);
    if (!series.x.empty()) chart.series.push_back(std::move(series));
  }
  if (target && !chart.series.empty()) {
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const ChartSeries& series : chart.series)
      for (const double cost : series.x) least = std::min(least, cost), most = std::max(most, cost);
    chart.series.push_back(
        {"target", {c.warning, LineStyle::dashed, 1.6f}, true, 0, {least, most}, {*target, *target}});
  }
  if (!study.present || (study.present->tolerance == 0 && study.present->dt < 0.9 * study.of.dt)) return chart;
  ChartSeries present{"present settings", {c.text, LineStyle::solid, 1}, false, 6, {}, {}};
  put(present, *study.present);
  if (!present.x.empty()) chart.series.push_back(std::move(present));
  return chart;
}

float stability_card_height(const Ui& ui, float) {
  return card_height(ui, stability_heading, words_at_1 + chart_at_1);
}

void stability_card(Ui& ui, float height) {
  if (begin_card(ui, stability_heading, height)) {
    if (const auto& limits = ui.session.studies.stability.limits()) {
      const Scheme& method = scheme(limits->of.integrator);
      const bool drawn = has_step_limit(method);
      const Chart chart = drawn            ? stability_chart(ui.theme.colors, *limits)
                          : limits->region ? region_chart(ui.theme.colors, *limits->region)
                                           : Chart{};
      words_and_chart(ui, height, stability_sentence(*limits), drawn || limits->region ? &chart : nullptr);
    }
  }
  end_card(ui);
}

float accuracy_card_height(const Ui& ui, float width) {
  const float ways_at_1 = ways_height(ui, card_width(ui, width)) / ui.theme.scale;
  if (ui.plots.accuracy == AccuracySide::settings)
    return card_height(ui, accuracy_heading, ways_at_1 + settings_finder_at_1(ui, card_width(ui, width)));
  const float words = ui.plots.accuracy == AccuracySide::convergence ? convergence_words_at_1 : words_at_1 + 70;
  return card_height(ui, accuracy_heading, ways_at_1 + words + chart_at_1);
}

namespace {

/// Errors of several methods, or the order of the present one; of that what else can be done with it.
void accuracy_ways(Ui& ui) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float whole = ways_height(ui, card_width(ui));
  AccuracySide& side = ui.plots.accuracy;
  if (const int k = segments(ui, "accuracy ways", accuracy_way_names, 3, int(side), ways_room_at_1, card_width(ui));
      k >= 0)
    side = AccuracySide(k);
  tooltip(ui, gui::item_id(),
          "Convergence: the error of the motion from now on with dt, dt/2, dt/4, … Find settings: the methods and dt "
          "that keep within an error of your choice, and their cost.");
  const auto at_right = [&](int n) {
    ImGui::SetCursorScreenPos(
        {lo.x + card_width(ui) - ui.theme.px(26.f * float(n + 1)), lo.y + whole - ui.theme.px(under_ways_at_1 + 24)});
  };
  if (side == AccuracySide::convergence) {
    at_right(0);
    if (quiet_button(ui, "csv_convergence", icon::download, "CSV", "Export the convergence as CSV…"))
      ui.command("export_convergence");
    at_right(1);
    if (quiet_button(ui, "again", icon::restart, "again", "Measure again from now on"))
      ui.command("measure_convergence");
  }
  ImGui::SetCursorScreenPos({lo.x, lo.y + whole});
}

constexpr EffectSet settings_of_the_method{Effect::integrator, Effect::dt, Effect::tolerance};

/// What there is to wait for while there is no result for the present constants.
std::string waiting_words(const Ui& ui) {
  const Session& session = ui.session;
  if (session.simulation->divergence()) return "The cloth has diverged: restart it to measure again.";
  const AccuracyWatch& watch = session.studies.accuracy;
  const auto measuring = watch.measuring();
  if (measuring && changes(measuring->of, session.preset()).within(motionless))
    return measuring_words(*measuring, session.now - watch.begun());
  if (session.simulation->held()) return "The error is measured once you let go of the cloth.";
  return "The error is measured once the constants stop changing for a moment.";
}

/// Beside a result that is of an earlier moment.
std::string later_words(const AccuracyStudy& measuring) {
  return " The error is being measured again from t = " + time_number(measuring.at.t, measuring.of.dt) +
         " s: " + std::to_string(int(100 * measuring.reference_part)) + " % of the fine runs are done.";
}

/// Shows an earlier study only as far as it is true of the present constants.
void errors_shown(Ui& ui, float height) {
  auto study = ui.session.studies.accuracy.study();
  const std::string waiting = waiting_words(ui);
  if (!study) return words_and_chart(ui, height, waiting, nullptr);
  const EffectSet since = changes(study->of, ui.session.preset());
  const bool stale = !since.within(motionless);
  // Errors of other methods stay true where only the present one's settings have changed.
  const bool charted = study->present && since.within(motionless | settings_of_the_method);
  if (stale) study->present.reset();
  const Chart chart = accuracy_chart(ui.theme.colors, *study, target_error(ui));
  const bool known = !stale && (study->present || !study->problem.empty());
  const auto measuring = ui.session.studies.accuracy.measuring();
  const bool later = measuring && measuring->at.t != study->at.t;
  words_and_chart(
      ui, height,
      known ? accuracy_words(*study) + (later ? later_words(*measuring) : other_methods_words(*study)) : waiting,
      charted ? &chart : nullptr);
}

/// How far the measurement of the order is.
std::string order_words(const Ui& ui, const std::optional<Convergence>& study) {
  const std::string method(scheme(ui.session.preset().integrator).title);
  if (!study && ui.session.simulation->divergence()) return "The cloth has diverged: restart it to measure again.";
  if (!study) return "The order of " + method + " is measured once the constants stop changing for a moment.";
  const std::string over = " over the next " + quantity(study->seconds, "s", 2);
  if (study->points.empty())
    return "Measuring the order of " + method + (study->seconds > 0 ? over : "") +
           ". First come fine runs for comparison, then " + std::to_string(convergence_levels) +
           " runs with dt, dt/2, dt/4, …";
  return "Measuring the order of " + method + over + ": " + std::to_string(study->points.size()) + " of " +
         std::to_string(convergence_levels) + " runs done; each takes about twice as long as the one before it.";
}

void convergence_shown(Ui& ui, float height) {
  auto study = ui.session.studies.convergence.study();
  // A measurement of other constants says nothing of these.
  if (study && !changes(study->of, ui.session.preset()).within(motionless)) study.reset();
  const std::string over = study ? " Over the " + short_number(rounded(study->seconds, 2)) +
                                       " s from t = " + time_number(study->t, study->of.dt) + " s, in double."
                                 : "";
  const Chart chart = study ? convergence_chart(ui.theme.colors, *study) : Chart{};
  words_and_chart(ui, height, study && study->done ? convergence_words(*study) + over : order_words(ui, study),
                  chart.series.empty() ? nullptr : &chart, convergence_words_at_1);
}

}  // namespace

void accuracy_card(Ui& ui, float height) {
  const auto study = ui.session.studies.accuracy.study();
  if (begin_card(ui, accuracy_heading, height, study ? accuracy_time(*study) : "")) {
    if (ui.session.simulation->lattice().size() > AccuracyWatch::largest) {
      words_and_chart(ui, height, "This cloth is too large to be measured here.", nullptr);
    } else {
      accuracy_ways(ui);
      const float rest = height - ways_height(ui, card_width(ui));
      constexpr std::array shown{errors_shown, convergence_shown, settings_finder};
      shown[std::size_t(ui.plots.accuracy)](ui, rest);
    }
  }
  end_card(ui);
}

}  // namespace tyglab
