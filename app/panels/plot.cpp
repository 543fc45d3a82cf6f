#include "app/panels/plot.h"

#include <algorithm>
#include <cmath>

#include "app/panels/numbers.h"
#include "app/panels/symbol.h"
#include "app/panels/widgets.h"

namespace tyglab {
namespace {

/// From values to pixels.
struct Axes {
  ImVec2 lo, hi;  ///< of the plot's own area
  double x_min, x_max, y_min, y_max;
  bool log;
  float x(double v) const { return lo.x + float((v - x_min) / (x_max - x_min)) * (hi.x - lo.x); }
  float y(double v) const {
    const double t = log ? std::log10(v / y_min) / std::log10(y_max / y_min) : (v - y_min) / (y_max - y_min);
    // Far values keep to a bounded height, so that pixels stay exact; the clip rectangle hides them.
    return hi.y - float(std::clamp(t, -3.0, 4.0)) * (hi.y - lo.y);
  }
  double value_at(float px) const { return x_min + (px - lo.x) / (hi.x - lo.x) * (x_max - x_min); }
  bool drawable(double v) const { return std::isfinite(v) && (!log || v > 0); }
};

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

class CurveDrawer {
 public:
  CurveDrawer(App& app, ImDrawList& draw, const Axes& axes, std::span<const double> x, Window window)
      : app_(app), draw_(draw), axes_(axes), x_(x), window_(window) {}

  void curve(const PlotCurve& curve) {
    std::vector<ImVec2> points;
    // Dashes stay with the data while the window moves over it.
    float phase = window_.first < window_.last ? float(std::fmod(axes_.x(x_[window_.first]) - axes_.x(0), 1e4)) : 0;
    phase = std::max(phase, 0.f);
    const auto flush = [&] {
      draw_styled_line(draw_, points.data(), int(points.size()), curve.style, app_.theme.scale, &phase);
      points.clear();
    };
    float column = -1e9f;
    for (std::size_t n = window_.first; n < window_.last; ++n) {
      const double v = curve.y[n];
      if (!axes_.drawable(v)) {
        flush();
        if (!std::isfinite(v)) flag(axes_.x(x_[n]), true, curve.style.color);
        continue;
      }
      const float at = axes_.x(x_[n]), y = axes_.y(v);
      if (v > axes_.y_max * (1 + 1e-9)) flag(at, true, curve.style.color);
      if (v < axes_.y_min - 1e-9 * std::abs(axes_.y_min)) flag(at, false, curve.style.color);
      // Samples closer than half a pixel add nothing to see unless they swing.
      if (at - column < 0.5f && !points.empty() && std::abs(y - points.back().y) < 1) continue;
      column = at;
      points.push_back({at, y});
    }
    flush();
  }

 private:
  /// A small triangle at the edge: here a curve has left the scale.
  void flag(float x, bool above, ImU32 color) {
    float& last = above ? last_above_ : last_below_;
    const float r = app_.theme.px(4);
    if (x < axes_.lo.x || x > axes_.hi.x || std::abs(x - last) < 3 * r) return;
    last = x;
    const float edge = above ? axes_.lo.y + 1 : axes_.hi.y - 1, tip = above ? -1.f : 1.f;
    const float base = edge - tip * 1.6f * r;
    draw_.AddTriangleFilled({x - r, base}, {x + r, base}, {x, edge}, color);
  }

  App& app_;
  ImDrawList& draw_;
  const Axes& axes_;
  std::span<const double> x_;
  Window window_;
  float last_above_ = -1e9f, last_below_ = -1e9f;
};

void draw_axes(App& app, ImDrawList& draw, const Axes& axes, const PlotRange& range, const PlotFrame& frame) {
  const Tokens& c = app.theme.colors;
  const ImFont& font = *app.fonts.small;
  draw.AddRectFilled(axes.lo, axes.hi, c.ground, app.theme.px(3));
  for (double tick : range.ticks) {
    const float y = std::round(axes.y(tick));
    draw.AddLine({axes.lo.x, y}, {axes.hi.x, y}, faded(c.line, tick == 0 ? 1.f : 0.7f));
    const std::string label = short_number(rounded(tick, 6));
    const float top = std::clamp(y - font.FontSize / 2, axes.lo.y - font.FontSize / 2, axes.hi.y - font.FontSize + 2);
    draw_text(draw, font, {axes.lo.x - app.theme.px(6) - text_width(font, label), std::round(top)}, c.quiet, label);
  }
  const float below = axes.hi.y + app.theme.px(4);
  const std::string from = short_number(rounded(frame.x_min, 4)) + " s",
                    to = short_number(rounded(frame.x_max, 4)) + " s";
  draw_text(draw, font, {axes.lo.x, below}, c.quiet, from);
  draw_text(draw, font, {axes.hi.x - text_width(font, to), below}, c.quiet, to);
}

float label_width(App& app, const PlotRange& range) {
  float width = app.theme.px(38);
  for (double tick : range.ticks)
    width = std::max(width, text_width(*app.fonts.small, short_number(rounded(tick, 6))) + app.theme.px(7));
  return width;
}

void read_out(App& app, ImDrawList& draw, const Axes& axes, std::span<const double> x,
              std::span<const PlotCurve> curves, std::string_view unit) {
  const double wanted = axes.value_at(ImGui::GetIO().MousePos.x);
  auto after = std::lower_bound(x.begin(), x.end(), wanted);
  if (after == x.end()) --after;
  if (after != x.begin() && wanted - *(after - 1) < *after - wanted) --after;
  const auto n = std::size_t(after - x.begin());
  const Tokens& c = app.theme.colors;
  const float at = std::round(axes.x(x[n]));
  draw.AddLine({at, axes.lo.y}, {at, axes.hi.y}, faded(c.text, 0.4f));
  for (const PlotCurve& curve : curves)
    if (axes.drawable(curve.y[n]))
      draw.AddCircleFilled({at, axes.y(curve.y[n])}, app.theme.px(3), curve.style.color, 12);
  begin_tooltip_at_pointer(app);
  ImGui::PushFont(app.fonts.mono);
  wrapped(app, "t = " + time_number(x[n], app.preset().dt) + " s", c.quiet);
  ImDrawList& tip = *ImGui::GetWindowDrawList();
  for (const PlotCurve& curve : curves) {
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    const float line = app.theme.px(20), middle = std::round(lo.y + line / 2);
    const ImVec2 sample[2] = {{lo.x, middle}, {lo.x + app.theme.px(24), middle}};
    draw_styled_line(tip, sample, 2, curve.style, app.theme.scale);
    draw_symbol(tip, app.fonts, {lo.x + app.theme.px(32), baseline_at(app.fonts, middle)}, curve.symbol, c.text);
    const std::string value = steady_number(curve.y[n]) + " " + std::string(unit);
    draw_on_baseline(tip, *app.fonts.mono, {lo.x + app.theme.px(80), baseline_at(app.fonts, middle)}, c.text, value);
    ImGui::Dummy({app.theme.px(84) + text_width(*app.fonts.mono, value), line - ImGui::GetStyle().ItemSpacing.y});
  }
  ImGui::PopFont();
  end_tooltip(app);
}

}  // namespace

float draw_plot(App& app, const char* id, ImVec2 size, std::span<const double> x, std::span<const PlotCurve> curves,
                const PlotFrame& frame) {
  const Tokens& c = app.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos(), hi{lo.x + size.x, lo.y + size.y};
  ImGui::InvisibleButton(id, size);
  const bool hovered = ImGui::IsItemHovered() && !app.ui.help;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const PlotRange range = plot_range(x, curves, frame);
  const ImFont& font = *app.fonts.small;
  const Axes axes{{lo.x + label_width(app, range), lo.y + std::round(font.FontSize / 2)},
                  {hi.x, hi.y - font.FontSize - app.theme.px(6)},
                  frame.x_min,
                  frame.x_max,
                  range.lo,
                  range.hi,
                  frame.log};
  if (axes.hi.x - axes.lo.x < 8 || axes.hi.y - axes.lo.y < 8) return 0;
  draw_axes(app, draw, axes, range, frame);
  if (x.empty() || curves.empty()) {
    const float width = text_width(font, frame.when_empty);
    draw_text(draw, font, {std::round((axes.lo.x + axes.hi.x - width) / 2), std::round((axes.lo.y + axes.hi.y) / 2)},
              c.quiet, frame.when_empty);
    return 0;
  }
  draw.PushClipRect(axes.lo, axes.hi, true);
  CurveDrawer drawer(app, draw, axes, x, window_of(x, frame));
  for (const PlotCurve& curve : curves) drawer.curve(curve);
  draw.PopClipRect();
  if (!hovered) return 0;
  if (ImGui::GetIO().MousePos.x >= axes.lo.x) read_out(app, draw, axes, x, curves, frame.unit);
  return ImGui::GetIO().MouseWheel;
}

}  // namespace tyglab
