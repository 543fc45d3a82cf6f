// The window's plots: curves over simulated time, with a read-out under the pointer.
#pragma once

#include <string_view>

#include "app/ui/kit/curve_plot.h"
#include "app/ui/kit/ui_context.h"

namespace tyglab {

struct PlotFrame {
  double x_min, x_max;  ///< s
  bool log = false;
  bool from_zero = false;  ///< a linear axis of magnitudes begins at 0
  std::string_view unit;
  std::string_view when_empty;  ///< said where there is nothing to plot, or all of it was earlier
  double time_step = 1e-3;      ///< s, that the read-out of t tells apart
};

/// The scale of the y axis: it holds nearly all of what the window shows. A few values far beyond (a blow-up) do not
/// flatten the rest; they leave the scale and are flagged.
PlotRange plot_range(std::span<const PlotCurve> curves, const PlotFrame& frame);

/// Draws it at the cursor, with axes, flags for what is off the scale, and a read-out under the pointer. The curves
/// share their x. Returns how far the wheel was turned over it, where it does not scroll the column.
float draw_plot(UiContext& ui, const char* id, ImVec2 size, std::span<const PlotCurve> curves, const PlotFrame& frame);

}  // namespace tyglab
