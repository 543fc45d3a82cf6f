// Curves with axes, linear or logarithmic, robust against huge values, for the window's plots and the benchmarks'
// pictures.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/ui/kit/fonts.h"
#include "app/ui/kit/theme.h"

namespace tyglab {

/// Where and with what a plot is drawn.
struct PlotPaint {
  ImDrawList& draw;
  const Theme& theme;
  const Fonts& fonts;
};

/// One direction of a plot: `lo` at its beginning, `hi` at its end.
struct PlotScale {
  double lo = 0, hi = 1;
  bool log = false;
  bool drawable(double v) const { return std::isfinite(v) && (!log || v > 0); }
  /// 0 at lo, 1 at hi; values far away keep to a bounded number, so that pixels stay exact.
  double at(double v) const {
    const double t = log ? std::log10(v / lo) / std::log10(hi / lo) : (v - lo) / (hi - lo);
    return std::clamp(t, -1e4, 1e4);
  }
};

/// From values to pixels.
struct PlotAxes {
  ImVec2 lo, hi;  ///< corners of the plot's own area
  PlotScale x, y;
  float px(double v) const { return lo.x + float(x.at(v)) * (hi.x - lo.x); }
  float py(double v) const { return hi.y - float(std::clamp(y.at(v), -3.0, 4.0)) * (hi.y - lo.y); }
};

/// `x` and `y` have the same length.
struct PlotCurve {
  std::string_view symbol;  ///< of the read-out, or its name in a legend
  CurveStyle style;
  std::span<const double> x, y;
  bool line = true;
  float marks = 0;                             ///< radius of a disc at each point, at scale 1; 0: none
  bool hollow = false;                         ///< rings in place of discs
  std::size_t from = 0, to = std::size_t(-1);  ///< only the samples [from, to) are drawn
  std::span<const std::size_t> gaps = {};      ///< samples that no line leads to, ascending
};

struct PlotTick {
  double at;
  std::string label;
};

/// The span of an axis and its ticks.
struct PlotRange {
  double lo, hi;
  std::vector<double> ticks;
};
/// Decades between the least and the most, both positive; at most `most_decades`, counted from above.
PlotRange log_range(double least, double most, int most_decades = 6);
/// Round steps that hold the least and the most; 0 too if `from_zero`.
PlotRange linear_range(double least, double most, bool from_zero);
/// Leaves a twentieth of the axis free above the most, and below the least where the axis does not begin at 0.
void add_headroom(PlotRange& range, double least, double most, bool log);
/// With labels as short as they can be.
std::vector<PlotTick> labeled(std::span<const double> ticks);

/// A disc, or a ring, of that radius at scale 1.
void draw_mark(const PlotPaint& paint, ImVec2 at, float radius, ImU32 color, bool hollow);
/// Ground and horizontal lines, their labels to the left of it.
void draw_ground(const PlotPaint& paint, const PlotAxes& axes, std::span<const PlotTick> y_ticks);
/// Vertical lines with labels below, the unit after the last; labels that would touch the one before are left out.
void draw_x_ticks(const PlotPaint& paint, const PlotAxes& axes, std::span<const PlotTick> ticks,
                  std::string_view unit = {});
/// Ink of a name in a legend, and of its sample: quiet where the curve is hidden.
struct LegendInk {
  ImU32 name;
  CurveStyle sample;
};
LegendInk legend_ink(const Tokens& colors, const CurveStyle& style, bool hidden, bool hovered);
/// A stroke through the name of a curve that is hidden, from `lo` on, as long as that.
void strike_out(const PlotPaint& paint, ImVec2 lo, float length);

/// The width that the names of the curves need beside their ends, px.
float end_labels_width(const PlotPaint& paint, std::span<const PlotCurve> curves);
/// Draws the names beside the ends of the samples [first, last), each with a stroke of its curve's color, up to x =
/// `right`; in a plot too low for all of them, none.
void draw_end_labels(const PlotPaint& paint, const PlotAxes& axes, std::span<const PlotCurve> curves, std::size_t first,
                     std::size_t last, float right);
/// The points [first, last) of a curve. What is not finite interrupts it; where it leaves the scale stands a flag.
void draw_curve(const PlotPaint& paint, const PlotAxes& axes, const PlotCurve& curve, std::size_t first,
                std::size_t last);

}  // namespace tyglab
