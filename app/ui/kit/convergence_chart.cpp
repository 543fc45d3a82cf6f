#include "app/ui/kit/chart.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

std::string order_words(const char* format, double order) {
  std::array<char, 40> text;
  std::snprintf(text.data(), text.size(), format, order);
  return text.data();
}

/// A straight line of that slope through a point, from the coarsest dt to the finest.
ChartSeries slope_line(const std::string& name, CurveStyle style, double slope, double dt, double error,
                       const Convergence& study) {
  ChartSeries line{name, style, true, 0, {}, {}};
  for (const double at : {study.points.front().dt, study.points.back().dt})
    line.x.push_back(at), line.y.push_back(error * std::pow(at / dt, slope));
  return line;
}

}  // namespace

Chart convergence_chart(const Tokens& c, const Convergence& study) {
  Chart chart;
  chart.padding = 0;
  chart.x.title = "dt, s", chart.x.log = true;
  chart.y.title = by_reference(study) ? "error, m (rms)" : "difference to dt/2, m (rms)", chart.y.log = true;
  CurveStyle style = integrator_style(c, study.of.integrator);
  ChartSeries measured{std::string(scheme(study.of.integrator).title), style, true, 3.5f, {}, {}};
  ChartSeries hidden{"too small to resolve", {c.quiet, LineStyle::solid, 1}, false, 3, {}, {}};
  double middle_dt = 0, middle_error = 0;
  const auto order = measured_order(study);
  int inside = 0;
  for (const ConvergencePoint& point : study.points) {
    const auto shown = shown_error(study, point);
    const double error = shown ? *shown : by_reference(study) ? point.error_rms_m : 0;
    if (!std::isfinite(error) || error <= 0) continue;
    ChartSeries& to = shown ? measured : hidden;
    to.x.push_back(point.dt), to.y.push_back(error);
    if (!order || &to == &hidden || point.dt > order->coarsest * (1 + 1e-9)) continue;
    middle_dt += std::log(point.dt), middle_error += std::log(error), ++inside;
  }
  if (!measured.x.empty()) chart.series.push_back(std::move(measured));
  if (!hidden.x.empty()) chart.series.push_back(std::move(hidden));
  if (!order || inside == 0) return chart;
  const double dt = std::exp(middle_dt / inside), error = std::exp(middle_error / inside);
  chart.series.push_back(slope_line(order_words("measured %.2f", order->order), {c.text, LineStyle::dashed, 1.4f},
                                    order->order, dt, error, study));
  const int nominal = nominal_order(study.of);
  chart.series.push_back(
      slope_line(order_words("nominal %.0f", nominal), {c.quiet, LineStyle::dotted, 1.4f}, nominal, dt, error, study));
  return chart;
}

}  // namespace tyglab
