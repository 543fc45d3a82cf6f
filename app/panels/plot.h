// Every plot of the program: curves over simulated time, linear or logarithmic, that survive a blow-up.
#pragma once

#include <imgui.h>

#include <span>
#include <string_view>
#include <vector>

#include "app/panels/theme.h"
#include "app/sandbox/app.h"

namespace tyglab {

struct PlotCurve {
  std::string_view symbol;  ///< of the read-out
  CurveStyle style;
  std::span<const double> y;
};

struct PlotFrame {
  double x_min, x_max;  ///< s
  bool log = false;
  bool from_zero = false;  ///< a linear axis of magnitudes begins at 0
  std::string_view unit;
  std::string_view when_empty;  ///< said where there is nothing to plot
};

/// The scale of the y axis: it holds nearly all of what the window shows. A few values far beyond (a blow-up) do not
/// flatten the rest; they leave the scale and are flagged.
struct PlotRange {
  double lo, hi;
  std::vector<double> ticks;
};
PlotRange plot_range(std::span<const double> x, std::span<const PlotCurve> curves, const PlotFrame& frame);

/// Draws it at the cursor, with axes, flags for what is off the scale, and a read-out under the pointer. Returns how
/// far the wheel was turned over it.
float draw_plot(App& app, const char* id, ImVec2 size, std::span<const double> x, std::span<const PlotCurve> curves,
                const PlotFrame& frame);

}  // namespace tyglab
