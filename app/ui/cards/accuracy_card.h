// The results of linear theory and of trial runs for the present settings, and other settings that keep an error, as
// two cards of the plots column.
#pragma once

#include <optional>
#include <string>

#include "app/ui/kit/chart.h"
#include "app/ui/state/ui.h"
#include "core/analysis/settings_search.h"

namespace tyglab {

/// Growth of an oscillation per step over ω·dt, with the cloth's fastest modes marked.
void stability_card(Ui& ui, float height);
float stability_card_height(const Ui& ui, float width);

/// Error of the present settings and of other methods over their run time.
void accuracy_card(Ui& ui, float height);
float accuracy_card_height(const Ui& ui, float width);

/// The chart of a study: error over cost, a line for each method, the present settings as a disc of their own, and a
/// line at the error that settings are looked for (m), which the axis then holds.
Chart accuracy_chart(const Tokens& colors, const AccuracyStudy& study, std::optional<double> target = {});
/// Over which time the errors of a study are, for the card's head: "over the next 0.25 s"; nothing while none is known.
std::string accuracy_time(const AccuracyStudy& study);
/// Its sentences: "Verlet: error 2.1e-05 m (rms) over the next 0.25 s from t = 1.2 s; …", and why that time is short.
std::string accuracy_words(const AccuracyStudy& study);
/// What is being measured, how much of it is done, and how long it may take; `elapsed`: s since it began.
std::string measuring_words(const AccuracyStudy& study, double elapsed);
/// How many other methods stand in the chart by now, after the rest; empty where none is to come.
std::string other_methods_words(const AccuracyStudy& study);
/// "Find settings" in the card of accuracy (settings_finder.cpp): an error goes in, methods and dt that keep it come
/// out, the cheapest first, each with a click to use it.
void settings_finder(Ui& ui, float height);
float settings_finder_at_1(const Ui& ui, float width);  ///< its height in that width (px), pixels at scale 1
/// The error that is typed there, m; none while it is no number in the range of a tolerance.
std::optional<double> target_error(const Ui& ui);
/// What is known for that error, in sentences: how far the search has come, over which time, or why there is nothing.
std::string finder_words(const SettingsSearch& search, double tolerance, const Preset& now, bool stopped = false);

/// The chart of a method's spectral radius.
Chart stability_chart(const Tokens& colors, const StabilityLimits& limits);
/// The region of a stabilized method in the plane of hλ, and in it the bounds of the cloth's hλ in any shape.
Chart region_chart(const Tokens& c, const StabilityRegion& region);

}  // namespace tyglab
