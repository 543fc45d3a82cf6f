// The window's plots: curves over simulated time, with a read-out under the pointer.
#pragma once

#include <string_view>

#include "app/ui/app.h"
#include "app/ui/kit/curve_plot.h"

namespace tyglab {

struct PlotFrame {
  double x_min, x_max;  ///< s
  bool log = false;
  bool from_zero = false;  ///< a linear axis of magnitudes begins at 0
  std::string_view unit;
  std::string_view when_empty;  ///< said where there is nothing to plot
};

/// The scale of the y axis: it holds nearly all of what the window shows. A few values far beyond (a blow-up) do not
/// flatten the rest; they leave the scale and are flagged.
PlotRange plot_range(std::span<const PlotCurve> curves, const PlotFrame& frame);

/// A frame of the newest of a series: the time that the wheel has set, or else as little as holds it, up to ten
/// seconds.
PlotFrame time_frame(const App& app, const Series& series, bool log, std::string_view unit,
                     std::string_view when_empty);
/// What is said in place of curves where nothing has moved yet.
const char* why_empty(const App& app);
/// Takes a turn of the wheel (draw_plot) for all plots over time.
void zoom_time(App& app, const PlotFrame& frame, float wheel);

/// Draws it at the cursor, with axes, flags for what is off the scale, and a read-out under the pointer. The curves
/// share their x. Returns how far the wheel was turned over it, where it does not scroll the column.
float draw_plot(App& app, const char* id, ImVec2 size, std::span<const PlotCurve> curves, const PlotFrame& frame);

}  // namespace tyglab
