#include "app/ui/cards/cards.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "app/base/text.h"

namespace tyglab {

namespace {

/// s; once nothing moves after a divergence, the time in which it happened, so that its growth is seen. `unseen`: how
/// long ago the last sample is; after an undo and a redo of the divergence its growth may have none.
double blow_up_span(const Ui& ui, double length, double unseen) {
  constexpr double steps = 250, least = 0.25;  // that growth takes; s
  const Session& session = ui.session;
  const double span = std::min(length, std::max(steps * session.preset().dt, least));
  const bool stands = session.simulation->divergence() && !session.copies.lockstep.alive();
  return stands && unseen < span ? span : std::numeric_limits<double>::infinity();
}

}  // namespace

const char* why_empty(const Ui& ui) {
  if (ui.session.simulation->divergence()) return "Restart to see curves";
  if (ui.session.pacing.playing) return "Waiting for the first step";
  return ui.input.by_touch ? "Tap the triangle (Run) at the top" : "Press Space to run";
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
  const double window =
      window_s.value_or(length > 0 ? std::min(usual, blow_up_span(ui, length, now - series.t().back())) : usual);
  const double end = std::max(now, window);
  return {end - window, end};
}

}  // namespace

PlotFrame time_frame(const Ui& ui, const Series& series, bool log, std::string_view unit, std::string when_empty) {
  const auto [begin, end] = shown_time(ui, series);
  if (!series.empty() && series.t().back() < begin)
    when_empty = "No samples after t = " + short_number(series.t().back(), 3) + " s";
  return {.x_min = begin,
          .x_max = end,
          .log = log,
          .from_zero = true,
          .unit = unit,
          .when_empty = std::move(when_empty),
          .time_step = ui.session.preset().dt};
}

void zoom_time(Ui& ui, const PlotFrame& frame, float wheel) {
  if (wheel != 0) ui.plots.window_s = std::clamp((frame.x_max - frame.x_min) * std::pow(0.8, wheel), 0.1, 120.0);
}

}  // namespace tyglab
