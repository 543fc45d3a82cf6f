// The names of the cards in the plots column, as on their tabs and headings.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/base/settings.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/overlay_layout.h"
#include "app/ui/state/ui.h"
#include "core/analysis/settings_search.h"
#include "core/energy/ledger.h"

namespace tyglab {

struct Ui;

namespace card_name {
inline constexpr const char *height = "Height", *forces = "Forces", *distances = "Distances", *map = "Map",
                            *step = "Step", *copies = "Copies", *stability = "Stability", *accuracy = "Accuracy",
                            *energy = "Energy", *performance = "Performance", *verification = "Verification";
}

/// Whether it is the card whose tab is chosen.
bool in_front(const Ui& ui, std::string_view name);
/// Brings a card into sight: the column, its tab where it is one, what stands under its heading.
void show_card(Ui& ui, std::string_view name);
/// The card that a lab's step calls so (lab_cards); null: none.
const char* card_of_lab(std::string_view name);
/// What a lab's step shows, by its name in lab_cards; empty: nothing. In a narrow window the lab itself stays in sight:
/// the card is the one that its column shows.
void show_for_lab(Ui& ui, std::string_view name);
/// Closes what labs have opened so.
void close_lab_cards(Ui& ui);

// The card of the copies in lockstep: the list of copies, their costs, and their distances.

/// How far apart the cloths are, or their energies, over time, at the cursor.
void copies_plot(Ui& ui, ImVec2 size);

/// The card in the plots column, closed unless the user has opened it or added a copy, and its height (pixels).
void copies_card(Ui& ui, float height);
float copies_card_height(const Ui& ui, float width);

// The card of the energy ledger: the cloth's energies, the work on it, and the energy that the integrator added.

enum class EnergyKind { has, works, unexplained };

struct EnergyRow {
  EnergyKind kind;
  std::string_view name, help;
  double joule;
};
/// Rows of the card, in its order.
std::vector<EnergyRow> energy_rows(const LedgerReading& reading, const Preset& preset);

/// "0.013 % of the scene's energy": what stands beside the unexplained energy.
std::string share_text(const LedgerReading& reading);

/// The card in the plots column, closed unless the user has opened it, and its height (pixels).
void energy_card(Ui& ui, float height);
float energy_card_height(const Ui& ui, float width);

// The forces of the picked particle, their sums or their maxima, over time.

struct Ui;

/// The card, and the height below which its curves could not be read (px, of a card of that width).
void force_card(Ui& ui, float height);
float force_card_least(const Ui& ui, float width);

// The height of the mass on a spring over time, beside the curves of figure 3.2.

struct Ui;

/// The card, and the height below which its curves could not be read (px, of a card of that width).
void height_card(Ui& ui, float height);
float height_card_least(const Ui& ui, float width);

// The next step of the picked particle: formulas, formulas with numbers, results.

/// Writes it at the cursor, in that much room; it scrolls.
void inside_step(Ui& ui, ImVec2 size);

/// "d + dt² a", as the method's table says it.
std::string formula_of(const Scheme& method, const TracedAssignment& assignment);

// The map of stiffness against dt as a plot; a click sets both constants.

/// Draws the map at the cursor; a click takes stiffness and dt from it, resting says what became of a cell.
void stability_map(Ui& ui, ImVec2 size);

// The gallery of `tyglab verify`.

/// Lists its cases at the cursor, with a button that measures them.
void verification(Ui& ui, ImVec2 size);
/// "12 of 12 hold, 12 of 40 measured.": how far a run has come.
std::string verify_words(const VerifyFindings& findings, bool running);

// The parts of a frame and a step: which ran, which were skipped, and their times.

enum class Activity { on, skipped, asleep };
std::string_view name_of(Activity activity);

/// A part of the work that a scene may need or not.
struct FeatureRow {
  std::string_view name, help;
  Activity activity;
  std::optional<double> ms;  ///< a frame; none where the step's one pass does it, which has a row of its own
};
std::vector<FeatureRow> feature_rows(const Ui& ui);

/// A number of the whole: name and value with its unit, and what is to be said of it, which may be nothing.
struct PerformanceFact {
  std::string_view name;
  std::string value, help = {};
};
std::vector<PerformanceFact> performance_facts(const Ui& ui);

/// The card at the foot of the plots column, closed unless the user has opened it, and its height (pixels).
void performance_card(Ui& ui, float height);
float performance_card_height(const Ui& ui, float width);

// The column of plots and cards.

void plots_panel(Ui& ui, const Region& region);
/// What the cards that it shows in a region of that size (px) want to be worked out, drawn or not; where it has none,
/// but will have its turn, what is recorded for then.
Wants plots_want(const Ui& ui, ImVec2 size, bool take_turns);

// Plots over simulated time share one visible time span.

/// A frame of the newest of a series: the time that the wheel has set, or else as little as holds it, up to ten
/// seconds.
PlotFrame time_frame(const Ui& ui, const Series& series, bool log, std::string_view unit, std::string when_empty);
/// What is said in place of curves where nothing has moved yet.
const char* why_empty(const Ui& ui);
/// Takes a turn of the wheel (draw_plot) for all plots over time.
void zoom_time(Ui& ui, const PlotFrame& frame, float wheel);

// The results of linear theory and of trial runs for the present settings, and other settings that keep an error, as
// two cards of the plots column.

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
