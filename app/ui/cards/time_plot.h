// Plots over simulated time share one visible time span.
#pragma once

#include <string_view>

#include "app/ui/kit/plot.h"
#include "app/ui/state/ui.h"

namespace tyglab {

/// A frame of the newest of a series: the time that the wheel has set, or else as little as holds it, up to ten
/// seconds.
PlotFrame time_frame(const Ui& ui, const Series& series, bool log, std::string_view unit, std::string_view when_empty);
/// What is said in place of curves where nothing has moved yet.
const char* why_empty(const Ui& ui);
/// Takes a turn of the wheel (draw_plot) for all plots over time.
void zoom_time(Ui& ui, const PlotFrame& frame, float wheel);

}  // namespace tyglab
