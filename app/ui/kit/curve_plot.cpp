#include "app/ui/kit/curve_plot.h"

#include <algorithm>

#include "app/base/numbers.h"
#include "app/ui/kit/symbol.h"

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
  for (const double tick : ticks) out.push_back({tick, short_number(rounded(tick, 6))});
  return out;
}

void draw_mark(const PlotPaint& paint, ImVec2 at, float radius, ImU32 color, bool hollow) {
  const float scale = paint.theme.scale;
  if (hollow) return paint.draw.AddCircle(at, radius * scale, color, 16, 1.2f * scale);
  paint.draw.AddCircleFilled(at, radius * scale, color, 16);
}

void draw_ground(const PlotPaint& paint, const PlotAxes& axes, std::span<const PlotTick> y_ticks) {
  const Tokens& c = paint.theme.colors;
  const ImFont& font = *paint.fonts.small;
  paint.draw.AddRectFilled(axes.lo, axes.hi, c.ground, paint.theme.px(3));
  float last = -1e9f;
  for (const auto& [tick, label] : y_ticks) {
    const float y = std::round(axes.py(tick));
    paint.draw.AddLine({axes.lo.x, y}, {axes.hi.x, y}, faded(c.line, tick == 0 ? 1.f : 0.7f));
    const float top =
        std::max(std::min(y - font.FontSize / 2, axes.hi.y - font.FontSize + 2), axes.lo.y - font.FontSize / 2);
    if (std::abs(top - last) < font.FontSize) continue;
    last = top;
    draw_text(paint.draw, font, {axes.lo.x - paint.theme.px(6) - text_width(font, label), std::round(top)}, c.quiet,
              label);
  }
}

void draw_x_ticks(const PlotPaint& paint, const PlotAxes& axes, std::span<const PlotTick> ticks) {
  const Tokens& c = paint.theme.colors;
  const ImFont& font = *paint.fonts.small;
  float free_from = -1e9f;
  for (const auto& [tick, label] : ticks) {
    const float x = std::round(axes.px(tick)), width = text_width(font, label);
    paint.draw.AddLine({x, axes.lo.y}, {x, axes.hi.y}, faded(c.line, 0.7f));
    // The last one stays within the plot: beyond it a card may end.
    const float left = std::round(std::min(x - width / 2, axes.hi.x - width));
    if (left < free_from) continue;
    draw_text(paint.draw, font, {left, axes.hi.y + paint.theme.px(4)}, c.quiet, label);
    free_from = left + width + paint.theme.px(10);
  }
}

void draw_curve(const PlotPaint& paint, const PlotAxes& axes, const PlotCurve& curve, std::size_t first,
                std::size_t last) {
  CurveDrawer(paint, axes, curve).draw(std::max(first, curve.from), std::min(last, curve.to));
}

}  // namespace tyglab
