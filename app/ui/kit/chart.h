// A complete chart with title, axes and legend, for the benchmarks, and its PNG without a display.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/render/image.h"
#include "app/ui/kit/curve_plot.h"

namespace tyglab {

struct ChartAxis {
  std::string title;  ///< with its unit
  bool log = false;
  bool from_zero = false;  ///< a linear axis begins at 0
  std::vector<PlotTick>
      ticks;  ///< in place of worked-out ones: the axis then holds them, and half a step on either side
  std::optional<std::pair<double, double>> span = {};  ///< exactly this, in place of what holds the series
};

/// A filled rectangle under the curves; `hatched` too where its color alone would say something bad.
struct ChartCell {
  double x_lo, x_hi, y_lo, y_hi;
  ImU32 color;
  bool hatched = false;
};

struct ChartSeries {
  std::string name;  ///< empty: not in the legend
  CurveStyle style;
  bool line = true;
  float marks = 3;  ///< radius of the discs, at scale 1; 0: none
  std::vector<double> x, y;
  bool hollow = false;  ///< rings in place of discs
};

struct Chart {
  std::string title;
  std::string note;  ///< a quiet line under the title
  ChartAxis x, y;
  std::vector<ChartSeries> series;
  std::vector<ChartCell> cells = {};
  float padding = 20;  ///< on all sides, at scale 1
};

/// A color and a line style for the k-th of many series, the same in every chart; alike only eight apart.
CurveStyle series_style(const Tokens& colors, int k);

/// Draws a chart into the rectangle: title, the plot, and as many lines of legend as it needs. Returns where values are
/// in it.
PlotAxes draw_chart(const PlotPaint& paint, ImVec2 at, ImVec2 size, const Chart& chart);

inline constexpr float chart_width = 640, chart_height = 400;  ///< points at scale 1

/// Charts side by side in rows of `columns`, each chart_width x `height` points at that scale, drawn in the OpenGL
/// context that is current, outside Dear ImGui's frames. Throws GraphicsError.
Image picture_of(const std::vector<Chart>& charts, int columns = 2, float scale = 2, float height = chart_height);
/// Writes that picture as PNG ("-" is standard output). Needs no display (EGL's surfaceless platform). Throws
/// GraphicsError, OutputError.
void write_charts(const std::filesystem::path& file, const std::vector<Chart>& charts, Reach reach, int columns = 2,
                  float scale = 2, float height = chart_height);

}  // namespace tyglab
