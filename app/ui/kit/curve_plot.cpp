#include "app/ui/kit/curve_plot.h"

#include <algorithm>

#include "app/base/text.h"
#include "app/ui/kit/widgets.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

class CurveDrawer {
 public:
  CurveDrawer(const PlotPaint& paint, const PlotAxes& axes, const PlotCurve& curve)
      : paint_(paint), axes_(axes), curve_(curve) {}

  void draw(std::size_t first, std::size_t last) {
    // Dashes stay with the data while the window moves over it.
    if (first < last && axes_.x.drawable(curve_.x[first]) && !axes_.x.log)
      phase_ = std::max(0.f, float(std::fmod(axes_.px(curve_.x[first]) - axes_.px(0), 1e4)));
    auto gap = std::lower_bound(curve_.gaps.begin(), curve_.gaps.end(), first);
    for (std::size_t n = first; n < last; ++n) {
      if (gap != curve_.gaps.end() && *gap == n) flush(), ++gap;
      point(curve_.x[n], curve_.y[n]);
    }
    flush();
  }

 private:
  void point(double x, double y) {
    if (!axes_.x.drawable(x) || !axes_.y.drawable(y)) {
      flush();
      if (!std::isfinite(y) && axes_.x.drawable(x)) flag(axes_.px(x), true);
      return;
    }
    const ImVec2 at{axes_.px(x), axes_.py(y)};
    if (y > axes_.y.hi * (1 + 1e-9)) flag(at.x, true);
    if (y < axes_.y.lo - 1e-9 * std::abs(axes_.y.lo)) flag(at.x, false);
    if (curve_.marks > 0) draw_mark(paint_, at, curve_.marks, curve_.style.color, curve_.hollow);
    // Samples closer than half a pixel add nothing to see unless they swing.
    if (!points_.empty() && std::abs(at.x - points_.back().x) < 0.5f && std::abs(at.y - points_.back().y) < 1) return;
    points_.push_back(at);
  }

  void flush() {
    if (curve_.line)
      draw_styled_line(paint_.draw, points_.data(), int(points_.size()), curve_.style, paint_.theme.scale, &phase_);
    points_.clear();
  }

  /// A small triangle at the edge: here the curve has left the scale.
  void flag(float x, bool above) {
    float& last = above ? last_above_ : last_below_;
    const float r = paint_.theme.px(4);
    if (x < axes_.lo.x || x > axes_.hi.x || std::abs(x - last) < 3 * r) return;
    last = x;
    const float edge = above ? axes_.lo.y + 1 : axes_.hi.y - 1, tip = above ? -1.f : 1.f;
    const float base = edge - tip * 1.6f * r;
    paint_.draw.AddTriangleFilled({x - r, base}, {x + r, base}, {x, edge}, curve_.style.color);
  }

  const PlotPaint& paint_;
  const PlotAxes& axes_;
  const PlotCurve& curve_;
  std::vector<ImVec2> points_;
  float phase_ = 0;
  float last_above_ = -1e9f, last_below_ = -1e9f;
};

}  // namespace

std::vector<PlotTick> labeled(std::span<const double> ticks) {
  std::vector<PlotTick> out;
  for (const double tick : ticks) out.push_back({tick, power_number(rounded(tick, 6))});
  return out;
}

void draw_mark(const PlotPaint& paint, ImVec2 at, float radius, ImU32 color, bool hollow) {
  const float scale = paint.theme.scale;
  if (hollow) return paint.draw.AddCircle(at, radius * scale, color, 16, 1.2f * scale);
  paint.draw.AddCircleFilled(at, radius * scale, color, 16);
}

void draw_ground(const PlotPaint& paint, const PlotAxes& axes, std::span<const PlotTick> y_ticks) {
  const Tokens& c = paint.theme.colors;
  const ImFont& font = *paint.fonts.axis;
  paint.draw.AddRectFilled(axes.lo, axes.hi, c.ground, paint.theme.px(3));
  std::vector<float> taken;
  const auto label_at = [&](const PlotTick& tick) {
    const float y = std::round(axes.py(tick.at));
    const float top =
        std::max(std::min(y - font.FontSize / 2, axes.hi.y - font.FontSize + 2), axes.lo.y - font.FontSize / 2);
    for (const float other : taken)
      if (std::abs(top - other) < font.FontSize) return;
    taken.push_back(top);
    draw_text(paint.draw, font, {axes.lo.x - paint.theme.px(6) - text_width(font, tick.label), std::round(top)},
              c.quiet, tick.label);
  };
  for (const PlotTick& tick : y_ticks) {
    const float y = std::round(axes.py(tick.at));
    paint.draw.AddLine({axes.lo.x, y}, {axes.hi.x, y}, faded(c.line, tick.at == 0 ? 1.f : 0.7f));
  }
  if (y_ticks.empty()) return;
  label_at(y_ticks.back()), label_at(y_ticks.front());  // the ends first: one of them has the unit
  for (const PlotTick& tick : y_ticks) label_at(tick);
}

void draw_x_ticks(const PlotPaint& paint, const PlotAxes& axes, std::span<const PlotTick> ticks,
                  std::string_view unit) {
  const Tokens& c = paint.theme.colors;
  const ImFont& font = *paint.fonts.axis;
  const float top = axes.hi.y + paint.theme.px(4), gap = paint.theme.px(10);
  const std::string end(unit);
  const float of_unit = text_width(font, end), last = axes.hi.x - (unit.empty() ? 0 : of_unit + paint.theme.px(4));
  if (!unit.empty()) draw_text(paint.draw, font, {axes.hi.x - of_unit, top}, c.quiet, end);
  float free_from = -1e9f;
  for (const auto& [tick, label] : ticks) {
    const float x = std::round(axes.px(tick)), width = text_width(font, label);
    paint.draw.AddLine({x, axes.lo.y}, {x, axes.hi.y}, faded(c.line, 0.7f));
    // The last one stays within the plot: beyond it a card may end.
    const float left = std::round(std::max(std::min(x - width / 2, last - width), axes.lo.x - width / 2));
    if (left < free_from) continue;
    draw_text(paint.draw, font, {left, top}, c.quiet, label);
    free_from = left + width + gap;
  }
}

namespace {

constexpr float end_gap_at_1 = 5, end_stroke_at_1 = 6;  // px: before the stroke, and its length

/// Whether it is a word rather than a symbol such as F_s.
bool is_word(std::string_view name) {
  return name.size() > 3 && name.find('_') == std::string_view::npos;
}

float name_width(const PlotPaint& paint, std::string_view name) {
  return is_word(name) ? text_width(*paint.fonts.small, name) : symbol_width(paint.fonts, name);
}

}  // namespace

float end_labels_width(const PlotPaint& paint, std::span<const PlotCurve> curves) {
  float widest = 0;
  for (const PlotCurve& curve : curves) widest = std::max(widest, name_width(paint, curve.symbol));
  return curves.empty() ? 0 : std::ceil(widest) + paint.theme.px(2 * end_gap_at_1 + end_stroke_at_1);
}

void draw_end_labels(const PlotPaint& paint, const PlotAxes& axes, std::span<const PlotCurve> curves, std::size_t first,
                     std::size_t last, float right) {
  const float gap = paint.theme.px(end_gap_at_1), stroke = paint.theme.px(end_stroke_at_1);
  const float line = std::round(paint.fonts.symbol->FontSize * 0.92f);
  const float lowest = axes.hi.y - line / 2, highest = axes.lo.y + line / 2, below_flags = highest + paint.theme.px(8);
  struct Label {
    const PlotCurve* curve;
    float left, right, y;
    bool beside(const Label& other) const { return right <= other.left || left >= other.right; }
  };
  std::vector<Label> labels;
  for (const PlotCurve& curve : curves) {
    const std::size_t end = std::min({last, curve.to, curve.x.size()});
    for (std::size_t n = end; n > std::max(first, curve.from); --n) {
      if (!axes.x.drawable(curve.x[n - 1]) || !axes.y.drawable(curve.y[n - 1])) continue;
      const float x = std::min(axes.px(curve.x[n - 1]), axes.hi.x), y = axes.py(curve.y[n - 1]);
      const float width = stroke + gap + name_width(paint, curve.symbol);
      const float left = std::round(std::min(x + gap, right - width));
      // Flags along the upper edge show where it goes on (draw_curve).
      const bool flagged = y < axes.lo.y || !std::isfinite(curve.y[end - 1]);
      labels.push_back({&curve, left - gap / 2, left + width, std::max(y, flagged ? below_flags : highest)});
      break;
    }
  }
  if (float(labels.size()) * line > axes.hi.y - axes.lo.y) return;
  std::stable_sort(labels.begin(), labels.end(), [](const Label& a, const Label& b) { return a.y < b.y; });
  // From the top down no higher than its curve's end, then from the bottom up as low as there is room.
  for (std::size_t k = 0; k < labels.size(); ++k)
    for (std::size_t above = 0; above < k; ++above)
      if (!labels[k].beside(labels[above])) labels[k].y = std::max(labels[k].y, labels[above].y + line);
  for (std::size_t k = labels.size(); k-- > 0;) {
    labels[k].y = std::min(labels[k].y, lowest);
    for (std::size_t below = k + 1; below < labels.size(); ++below)
      if (!labels[k].beside(labels[below])) labels[k].y = std::min(labels[k].y, labels[below].y - line);
  }
  for (const auto& [curve, from, to, y] : labels) {
    const float left = from + gap / 2, middle = std::round(y);
    paint.draw.AddRectFilled({from, middle - line / 2}, {to, middle + line / 2}, faded(paint.theme.colors.ground, 0.8f),
                             paint.theme.px(2));
    paint.draw.AddLine({left, middle}, {left + stroke, middle}, curve->style.color, 3 * paint.theme.scale);
    const ImVec2 foot{left + stroke + gap / 2, baseline_at(paint.fonts, middle)};
    is_word(curve->symbol)
        ? draw_on_baseline(paint.draw, *paint.fonts.small, foot, paint.theme.colors.text, curve->symbol)
        : draw_symbol(paint.draw, paint.fonts, foot, curve->symbol, paint.theme.colors.text);
  }
}

LegendInk legend_ink(const Tokens& c, const CurveStyle& style, bool hidden, bool hovered) {
  if (!hidden) return {c.text, style};
  CurveStyle quiet = style;
  quiet.color = c.quiet;
  return {hovered ? c.text : c.quiet, quiet};
}

void strike_out(const PlotPaint& paint, ImVec2 lo, float length) {
  const float thick = std::max(1.f, paint.theme.px(1));
  paint.draw.AddLine({lo.x - thick, lo.y}, {lo.x + length + thick, lo.y}, paint.theme.colors.quiet, thick);
}

void draw_curve(const PlotPaint& paint, const PlotAxes& axes, const PlotCurve& curve, std::size_t first,
                std::size_t last) {
  CurveDrawer(paint, axes, curve).draw(std::max(first, curve.from), std::min(last, curve.to));
}

}  // namespace tyglab
