#include "app/ui/kit/chart.h"

#include <algorithm>
#include <cmath>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

struct Window {
  std::size_t first, last;
};

/// The samples in sight, with one more on either side so that lines reach the edges.
Window window_of(std::span<const double> x, const PlotFrame& frame) {
  auto first = std::lower_bound(x.begin(), x.end(), frame.x_min);
  auto last = std::upper_bound(first, x.end(), frame.x_max);
  if (first != x.begin()) --first;
  if (last != x.end()) ++last;
  return {std::size_t(first - x.begin()), std::size_t(last - x.begin())};
}

/// The finite values that the window shows, thinned to a bounded number.
std::vector<double> values_in(std::span<const PlotCurve> curves, const PlotFrame& frame) {
  std::vector<double> values;
  for (const PlotCurve& curve : curves) {
    const auto first = std::size_t(std::lower_bound(curve.x.begin(), curve.x.end(), frame.x_min) - curve.x.begin());
    const auto last = std::size_t(std::upper_bound(curve.x.begin(), curve.x.end(), frame.x_max) - curve.x.begin());
    const std::size_t stride = std::max<std::size_t>(1, (last - first) / 1000);
    for (std::size_t n = first; n < last; n += stride)
      if (std::isfinite(curve.y[n]) && (!frame.log || curve.y[n] > 0)) values.push_back(curve.y[n]);
  }
  std::sort(values.begin(), values.end());
  return values;
}

double quantile(const std::vector<double>& sorted, double q) {
  return sorted[std::size_t(q * double(sorted.size() - 1))];
}

/// The unit stands after the topmost number.
void name_unit(std::vector<PlotTick>& ticks, std::string_view unit) {
  const auto by_value = [](const PlotTick& a, const PlotTick& b) { return a.at < b.at; };
  const auto top = std::max_element(ticks.begin(), ticks.end(), by_value);
  if (top != ticks.end() && !unit.empty()) top->label += " " + std::string(unit);
}

float label_width(UiContext& ui, std::span<const PlotTick> ticks) {
  float width = ui.theme.px(38);
  for (const PlotTick& tick : ticks) width = std::max(width, text_width(*ui.fonts.axis, tick.label) + ui.theme.px(7));
  return width;
}

/// Round times, with as many digits as tell them apart.
std::vector<PlotTick> time_ticks(double from, double to) {
  std::vector<PlotTick> ticks;
  const std::vector<double> times = linear_range(from, to, false).ticks;
  const int digits = digits_apart(times[times.size() - 2], times.back());
  for (const double t : times)
    if (t >= from && t <= to) ticks.push_back({t, short_number(rounded(t, digits), digits)});
  return ticks;
}

void read_out(UiContext& ui, ImDrawList& draw, const PlotAxes& axes, std::span<const PlotCurve> curves,
              const PlotFrame& frame) {
  const std::span<const double> x = curves.front().x;
  const double along = (ImGui::GetIO().MousePos.x - axes.lo.x) / (axes.hi.x - axes.lo.x);
  const double wanted = axes.x.lo + along * (axes.x.hi - axes.x.lo);
  auto after = std::lower_bound(x.begin(), x.end(), wanted);
  if (after == x.end()) --after;
  if (after != x.begin() && wanted - *(after - 1) < *after - wanted) --after;
  const auto n = std::size_t(after - x.begin());
  const Tokens& c = ui.theme.colors;
  const float at = std::round(axes.px(x[n]));
  draw.AddLine({at, axes.lo.y}, {at, axes.hi.y}, faded(c.text, 0.4f));
  const auto has = [&](const PlotCurve& curve) { return n >= curve.from && n < curve.to; };
  for (const PlotCurve& curve : curves)
    if (has(curve) && axes.y.drawable(curve.y[n]))
      draw.AddCircleFilled({at, axes.py(curve.y[n])}, ui.theme.px(3), curve.style.color, 12);
  begin_tooltip_at_pointer(ui);
  ImGui::PushFont(ui.fonts.mono);
  wrapped(ui, "t = " + time_number(x[n], frame.time_step) + " s", c.quiet);
  ImDrawList& tip = *ImGui::GetWindowDrawList();
  float names = ui.theme.px(48);
  for (const PlotCurve& curve : curves) names = std::max(names, symbol_width(ui.fonts, curve.symbol) + ui.theme.px(12));
  double largest = 0;  // one unit for all
  for (const PlotCurve& curve : curves)
    if (has(curve) && std::isfinite(curve.y[n])) largest = std::max(largest, std::abs(curve.y[n]));
  const ScaledUnit unit = scaled_unit(largest, frame.unit);
  for (const PlotCurve& curve : curves) {
    if (!has(curve) || !std::isfinite(curve.y[n])) continue;
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    const float line = ui.theme.px(20), middle = std::round(lo.y + line / 2);
    const ImVec2 sample[2] = {{lo.x, middle}, {lo.x + ui.theme.px(24), middle}};
    draw_styled_line(tip, sample, 2, curve.style, ui.theme.scale);
    draw_symbol(tip, ui.fonts, {lo.x + ui.theme.px(32), baseline_at(ui.fonts, middle)}, curve.symbol, c.text);
    const std::string value = steady_number(curve.y[n] / unit.size) + " " + unit.name;
    draw_on_baseline(tip, *ui.fonts.mono, {lo.x + ui.theme.px(32) + names, baseline_at(ui.fonts, middle)}, c.text,
                     value);
    ImGui::Dummy({ui.theme.px(36) + names + text_width(*ui.fonts.mono, value), line - ImGui::GetStyle().ItemSpacing.y});
  }
  ImGui::PopFont();
  end_tooltip(ui);
}

/// Whether the names of the curves leave the curves most of a width, px.
bool names_fit(const PlotPaint& paint, std::span<const PlotCurve> curves, float width) {
  constexpr float most = 0.42f;
  return end_labels_width(paint, curves) < most * width;
}

/// How much of that width, px, the axes leave to names beside the ends of the curves: nothing while the curves end so
/// early that the names have room in the plot.
float room_for_names(const PlotPaint& paint, std::span<const PlotCurve> curves, const PlotFrame& frame, float width) {
  if (!names_fit(paint, curves, width)) return 0;
  const double end = std::min(curves.front().x.back(), frame.x_max), names = end_labels_width(paint, curves);
  const double part = std::max((end - frame.x_min) / (frame.x_max - frame.x_min), 1e-3);
  return std::ceil(float(std::clamp(width - (width - names) / part, 0.0, names)));
}

}  // namespace

PlotRange plot_range(std::span<const PlotCurve> curves, const PlotFrame& frame) {
  const std::vector<double> values = values_in(curves, frame);
  if (values.empty()) return frame.log ? log_range(1e-3, 1) : linear_range(0, 1, true);
  const auto with_headroom = [&](PlotRange range, double least, double most) {
    add_headroom(range, least, most, frame.log);
    return range;
  };
  // Nearly all of the values count; beyond three times their spread begins what leaves the scale.
  const double low = quantile(values, 0.02), high = quantile(values, 0.97);
  if (frame.log) {
    const double least = std::max(values.front(), low * 1e-2), most = std::min(values.back(), high * 1e3);
    return with_headroom(log_range(least, most), least, most);
  }
  const double reach = 3 * std::max(high - low, 0.1 * std::abs(high));
  double least = values.front(), most = values.back();
  if (reach > 0) least = std::max(least, low - reach), most = std::min(most, high + reach);
  // What differs in no digit of the labels is one value: rounding would look like motion.
  constexpr double least_span = 1e-3;
  if (most - least < least_span * std::abs(least)) least = most = (least + most) / 2;
  return with_headroom(linear_range(least, most, frame.from_zero), least, most);
}

float draw_plot(UiContext& ui, const char* id, ImVec2 size, std::span<const PlotCurve> curves, const PlotFrame& frame) {
  const ImVec2 lo = ImGui::GetCursorScreenPos(), hi{lo.x + size.x, lo.y + size.y};
  gui::press_area(id, size);
  const bool hovered = ImGui::IsItemHovered() && !ui.covered;
  const PlotPaint paint{*ImGui::GetWindowDrawList(), ui.theme, ui.fonts};
  const PlotRange range = plot_range(curves, frame);
  std::vector<PlotTick> ticks = labeled(range.ticks);
  name_unit(ticks, frame.unit);
  const ImFont& font = *ui.fonts.axis;
  const bool empty = curves.empty() || curves.front().x.empty() || curves.front().x.back() < frame.x_min;
  const float left = lo.x + label_width(ui, ticks);
  const float names = empty ? 0 : room_for_names(paint, curves, frame, hi.x - left);
  const PlotAxes axes{{left, lo.y + std::round(font.FontSize / 2)},
                      {hi.x - names, hi.y - font.FontSize - ui.theme.px(6)},
                      {frame.x_min, frame.x_max},
                      {range.lo, range.hi, frame.log}};
  if (axes.hi.x - axes.lo.x < 8 || axes.hi.y - axes.lo.y < 8) return 0;
  draw_ground(paint, axes, ticks);
  draw_x_ticks(paint, axes, time_ticks(frame.x_min, frame.x_max), "s");
  if (empty) {
    const float pad = ui.theme.px(6);
    const std::string words = fitted(font, frame.when_empty, axes.hi.x - axes.lo.x - 2 * pad);
    const float width = text_width(font, words);
    const ImVec2 at{std::round((axes.lo.x + axes.hi.x - width) / 2), std::round((axes.lo.y + axes.hi.y) / 2)};
    paint.draw.AddRectFilled({at.x - pad, at.y}, {at.x + width + pad, at.y + font.FontSize}, ui.theme.colors.ground);
    draw_text(paint.draw, font, at, ui.theme.colors.quiet, words);
    return 0;
  }
  const auto [first, last] = window_of(curves.front().x, frame);
  paint.draw.PushClipRect(axes.lo, axes.hi, true);
  for (const PlotCurve& curve : curves) draw_curve(paint, axes, curve, first, last);
  paint.draw.PopClipRect();
  if (names_fit(paint, curves, hi.x - left)) draw_end_labels(paint, axes, curves, first, last, hi.x);
  if (!hovered) return 0;
  if (ImGui::GetIO().MousePos.x >= axes.lo.x) read_out(ui, paint.draw, axes, curves, frame);
  const bool scrolls = ui.wheel_scrolls && !ImGui::GetIO().KeyCtrl;
  return scrolls ? 0 : ImGui::GetIO().MouseWheel;
}

}  // namespace tyglab
