#include "app/ui/cards/cards.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tyglab {

namespace {

/// s; once nothing moves after a divergence, the time in which it happened, so that its growth is seen.
double blow_up_span(const Ui& ui, double length) {
  constexpr double steps = 250, least = 0.25;  // that growth takes; s
  const Session& session = ui.session;
  if (!session.simulation->divergence() || session.copies.lockstep.alive())
    return std::numeric_limits<double>::infinity();
  return std::min(length, std::max(steps * session.preset().dt, least));
}

}  // namespace

const char* why_empty(const Ui& ui) {
  if (ui.session.simulation->divergence()) return "Restart to see curves";
  if (ui.session.pacing.playing) return "Waiting for the first step";
  return ui.input.by_touch ? "Tap Run at the top" : "Press Space to run";
}

namespace {

/// The simulated time that a plot shows, s: the last of it or, in a replay, all of the replay.
std::pair<double, double> shown_time(const Ui& ui, const Series& series) {
  const auto& window_s = ui.plots.window_s;
  if (const auto& replay = ui.session.replay) {
    const double end = replay->of.t;
    return {end - window_s.value_or(Replay::steps * ui.session.preset().dt), end};
  }
  const double t = ui.session.simulation->time();
  // Of a plot that was hidden for a while the newest sample is no news of the cloth: its end would look like the
  // present.
  const double now = series.empty()               ? t
                     : ui.session.recorded.paused ? series.t().back()
                                                  : std::max(t, series.t().back());
  const double length = series.empty() ? 0 : now - series.t().front();
  const double usual = length <= 2 ? 2 : length <= 5 ? 5 : 10;
  const double window = window_s.value_or(length > 0 ? std::min(usual, blow_up_span(ui, length)) : usual);
  const double end = std::max(now, window);
  return {end - window, end};
}

}  // namespace

PlotFrame time_frame(const Ui& ui, const Series& series, bool log, std::string_view unit, std::string_view when_empty) {
  const auto [begin, end] = shown_time(ui, series);
  if (!series.empty() && series.t().back() < begin) when_empty = "Not recorded while the plot was hidden";
  return {.x_min = begin,
          .x_max = end,
          .log = log,
          .from_zero = true,
          .unit = unit,
          .when_empty = when_empty,
          .time_step = ui.session.preset().dt};
}

void zoom_time(Ui& ui, const PlotFrame& frame, float wheel) {
  if (wheel != 0) ui.plots.window_s = std::clamp((frame.x_max - frame.x_min) * std::pow(0.8, wheel), 0.1, 120.0);
}

}  // namespace tyglab
