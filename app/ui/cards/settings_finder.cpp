#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "app/base/text.h"
#include "app/ui/cards/cards.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/analysis/tolerance.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

// Pixels at scale 1.
constexpr float finder_field_at_1 = 92, finder_row_at_1 = 21, finder_gap_at_1 = 8, finder_number_at_1 = 64;
constexpr float finder_at_1 = 292, finder_button_at_1 = 34;

float asked_width(const Ui& ui) {
  const ImFont& font = *ui.fonts.text;
  return text_width(font, "Error at most") + text_width(font, "m") +
         ui.theme.px(finder_field_at_1 + 2 * finder_gap_at_1);
}

/// Where the button has no room beside the field, it stands below it.
bool find_below(const Ui& ui, float width) {
  const float button = std::max(text_width(*ui.fonts.text, "Find"), text_width(*ui.fonts.text, "Stop")) +
                       2 * ImGui::GetStyle().FramePadding.x;
  return asked_width(ui) + ui.theme.px(finder_gap_at_1) + button > width;
}

/// Where a method's name has no room beside its numbers, it stands above them.
bool methods_above(const Ui& ui, float width) {
  constexpr float least_name = 70;  // at scale 1
  return width < ui.theme.px(3 * finder_number_at_1 + least_name);
}

/// What a refusal says, and what can be promised in its place.
struct Refusal {
  std::string words;
  std::optional<double> tightest;  ///< m
};

std::optional<Refusal> refusal_of(const SettingsSearch& search, double tolerance) {
  try {
    reached_or_refused(search, tolerance);
    return std::nullopt;
  } catch (const ToleranceError& error) {
    return Refusal{sentence(error.what()), error.tightest};
  }
}

/// Asks for the error that is typed, or says what is wrong with it.
void ask_for_settings(Ui& ui) {
  if (const auto target = target_error(ui)) return ui.session.studies.settings.ask(*target, ui.session.preset());
  ui.session.messages.error(std::string("“") + ui.plots.target +
                            "” is not a length from 10⁻¹² to 1 m, such as 1e-4 or 0.1 mm.");
}

void type_target(Ui& ui, double tolerance) {
  std::snprintf(ui.plots.target, sizeof ui.plots.target, "%s", short_number(tolerance, 2).c_str());
  ask_for_settings(ui);
}

void target_row(Ui& ui) {
  const Tokens& c = ui.theme.colors;
  const float gap = ui.theme.px(finder_gap_at_1);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(gap, 0));
  // The field is as high as the button beside it.
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(ui.theme.px(8), ui.theme.px(7)));
  ImGui::AlignTextToFramePadding();
  wrapped(ui, "Error at most", c.text);
  ImGui::SameLine();
  const float spare = card_width(ui) - (asked_width(ui) - ui.theme.px(finder_field_at_1));
  ImGui::SetNextItemWidth(std::min(ui.theme.px(finder_field_at_1), spare));
  const bool enter =
      ImGui::InputText("##target", ui.plots.target, sizeof ui.plots.target, ImGuiInputTextFlags_EnterReturnsTrue);
  report_control(ui, "target");
  ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  wrapped(ui, "m", c.quiet);
  ImGui::PopStyleVar();
  if (find_below(ui, card_width(ui)))
    ImGui::Dummy({0, ui.theme.px(4)});
  else
    ImGui::SameLine();
  SettingsWatch& watch = ui.session.studies.settings;
  const bool searching = watch.searching();
  if (text_button(ui, searching ? "Stop" : "Find", !searching))
    searching ? watch.stop() : ask_for_settings(ui);
  else if (enter)
    ask_for_settings(ui);
  ImGui::PopStyleVar();
  ImGui::Dummy({0, ui.theme.px(6)});
}

/// Where the columns of numbers end, pixels from the left.
struct FinderColumns {
  float dt, error, cost, whole;
};

FinderColumns finder_columns(const Ui& ui) {
  const float whole = card_width(ui), cost = whole - ui.theme.px(2);
  const float number = std::min(ui.theme.px(finder_number_at_1), cost / 3);
  return {cost - 2 * number, cost - number, cost, whole};
}

void finder_number(Ui& ui, const ImFont& font, float right, float middle, ImU32 color, const std::string& text) {
  draw_on_baseline(*ImGui::GetWindowDrawList(), font, {right - text_width(font, text), baseline_at(ui.fonts, middle)},
                   color, text);
}

/// What the numbers of a column are in: one unit for all that keep the error.
struct FinderUnits {
  ScaledUnit dt, error;
};

FinderUnits finder_units(const std::vector<ErrorPoint>& points) {
  double dt = 0, error = 0;
  for (const ErrorPoint& point : points)
    error = std::max(error, point.error_rms_m), dt = std::max(dt, point.tolerance > 0 ? 0 : point.dt);
  return {scaled_unit(dt, "s"), scaled_unit(error, "m")};
}

/// `to`: what costs are relative to, "now" or "before"; null where they are not.
void finder_head(Ui& ui, const FinderUnits& units, const char* to) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const FinderColumns at = finder_columns(ui);
  const float middle = lo.y + ui.theme.px(card::line) / 2;
  const ImU32 color = ui.theme.colors.quiet;
  finder_number(ui, *ui.fonts.small, lo.x + at.dt, middle, color, "dt, " + units.dt.name);
  finder_number(ui, *ui.fonts.small, lo.x + at.error, middle, color, "error, " + units.error.name);
  const std::string brief = to != nullptr ? std::string("× ") + to : "s/s", whole = "CPU, " + brief;
  const bool fits = text_width(*ui.fonts.small, whole) <= at.cost - at.error - ui.theme.px(finder_gap_at_1);
  finder_number(ui, *ui.fonts.small, lo.x + at.cost, middle, color, fits ? whole : brief);
  ImGui::Dummy({at.whole, ui.theme.px(card::line)});
}

std::string two_digits_of(double value) {
  return power_number(rounded(value, 2));
}

/// Whether the method, its dt or tolerance, and the precision are the same.
bool same_settings(const Preset& a, const Preset& b) {
  const bool own = chooses_steps(scheme(a.integrator));
  return a.integrator == b.integrator && a.precision == b.precision &&
         (own ? a.tolerance == b.tolerance : a.dt == b.dt);
}

/// "Verlet and dt = 0.001 s".
std::string setting_words(const Preset& preset) {
  const Scheme& method = scheme(preset.integrator);
  return std::string(method.title) + " and " +
         (chooses_steps(method) ? "a tolerance of " + quantity(preset.tolerance, "m", 2)
                                : "dt = " + quantity(preset.dt, "s", 2));
}

/// The present settings' cost, processor seconds for a simulated second; none where it is not known.
std::optional<double> present_cost(const SettingsSearch& search) {
  if (!search.present || search.present->given_up || !(search.present->cost > 0)) return std::nullopt;
  return search.present->cost;
}

void finder_line(Ui& ui, int n, const SettingsSearch& search, const FinderUnits& units, const ErrorPoint& point) {
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const FinderColumns at = finder_columns(ui);
  const bool above = methods_above(ui, at.whole);
  const float row = ui.theme.px(finder_row_at_1), height = above ? 2 * row : row;
  const float name_middle = std::round(lo.y + row / 2), middle = above ? name_middle + row : name_middle;
  const Preset now = ui.session.requested_preset(), with = with_setting(now, point);
  const bool used = same_settings(now, with);
  ImGui::PushID(n);
  if (gui::press_area("setting", {at.whole, height})) ui.session.request(request::Apply{.edit = edit::Change{with}});
  report_control(ui, "setting" + std::to_string(n + 1));
  const bool hovered = ImGui::IsItemHovered();
  const bool own = point.tolerance > 0;
  const std::string step = own ? "tolerance " + quantity(with.tolerance, "m", 2) : "dt = " + quantity(with.dt, "s", 2);
  tooltip(ui, gui::item_id(),
          (used ? "In use: " : "Click to use ") + std::string(scheme(point.integrator).title) + " with " + step + ": " +
              quantity(point.cost, "s", 2) + " of CPU time per simulated second.");
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (hovered) draw.AddRectFilled(lo, {lo.x + at.whole, lo.y + height}, c.field, ui.theme.px(4));
  const float name = above ? at.whole : at.dt - ui.theme.px(finder_number_at_1 - 10);
  const float baseline = baseline_at(ui.fonts, name_middle), margin = ui.theme.px(4);
  float mark = 0;
  if (used) {
    const char* tick = icon_or(ui.fonts, icon::check, "+");
    draw_on_baseline(draw, *ui.fonts.text, {lo.x + margin, baseline}, c.good, tick);
    mark = text_width(*ui.fonts.text, tick) + margin;
  }
  draw_on_baseline(draw, *ui.fonts.small, {lo.x + margin + mark, baseline}, c.text,
                   fitted(*ui.fonts.small, std::string(scheme(point.integrator).title), name - mark));
  finder_number(ui, *ui.fonts.mono, lo.x + at.dt, middle, c.text, own ? "own" : two_digits_of(with.dt / units.dt.size));
  finder_number(ui, *ui.fonts.mono, lo.x + at.error, middle, c.text,
                two_digits_of(point.error_rms_m / units.error.size));
  const auto present = present_cost(search);
  finder_number(ui, *ui.fonts.mono, lo.x + at.cost, middle, c.text,
                two_digits_of(present ? point.cost / *present : point.cost));
  ImGui::PopID();
  ImGui::SetCursorScreenPos({lo.x, lo.y + height});
}

void finder_text(Ui& ui, const std::string& words) {
  ImGui::PushFont(ui.fonts.small);
  wrapped(ui, in_lines(*ui.fonts.small, words, card_width(ui)), ui.theme.colors.text);
  ImGui::PopFont();
  ImGui::Dummy({0, ui.theme.px(6)});
}

/// What was found, or what can be.
void finder_answer(Ui& ui, const SettingsSearch& search, double tolerance) {
  if (!SettingsWatch::is_about(search, ui.session.preset()))
    return finder_text(ui, "The constants have changed since these settings were measured. Press Find again.");
  finder_text(ui,
              finder_words(search, tolerance, ui.session.requested_preset(), ui.session.studies.settings.stopped()));
  if (search.done)
    if (const auto refusal = refusal_of(search, tolerance)) {
      if (refusal->tightest && text_button(ui, ("Use " + quantity(*refusal->tightest, "m", 2)).c_str(), true))
        ui.act([tightest = *refusal->tightest](Ui& later) { type_target(later, tightest); });
      return;
    }
  const std::vector<ErrorPoint> reached = settings_for(search, tolerance);
  if (reached.empty()) return;
  const bool present = same_settings(search.of, ui.session.requested_preset());
  const FinderUnits units = finder_units(reached);
  finder_head(ui, units, !present_cost(search) ? nullptr : present ? "now" : "before");
  for (std::size_t n = 0; n < reached.size(); ++n) finder_line(ui, int(n), search, units, reached[n]);
}

void finder_part(Ui& ui) {
  const SettingsWatch& watch = ui.session.studies.settings;
  if (!watch.tolerance())
    return finder_text(
        ui,
        "Tries methods and dt on the next second of this motion, and ranks by cost those that keep within this error.");
  if (ui.session.simulation->divergence() && !watch.search())
    return finder_text(ui, "The motion has diverged; restart it first.");
  const auto search = watch.search();
  if (!search) return finder_text(ui, "The search begins once you release the cloth and the present step is done.");
  finder_answer(ui, *search, *watch.tolerance());
}

}  // namespace

std::optional<double> target_error(const Ui& ui) {
  const auto typed = typed_number(ui.plots.target, "m");
  return typed && *typed >= 1e-12 && *typed <= 1 ? typed : std::nullopt;
}

std::string finder_words(const SettingsSearch& search, double tolerance, const Preset& now, bool stopped) {
  if (!search.done) {
    if (search.methods == 0)
      return stopped ? "Stopped before any method was tried. Find starts over."
                     : "First come fine runs for comparison, from t = " + short_number(search.t) +
                           " s: " + std::to_string(int(100 * search.reference_part)) + " % done.";
    const std::string tried = std::to_string(search.methods_done) + " of " + std::to_string(search.methods);
    const std::string settings = std::to_string(search.points.size()) + " settings tried.";
    return stopped ? "Stopped after " + tried + " methods, " + settings
                   : "Trying methods: " + tried + " done, " + settings;
  }
  if (const auto refusal = refusal_of(search, tolerance)) return refusal->words;
  std::string words = "Largest rms position errors over the " + quantity(search.seconds, "s", 2) +
                      " from t = " + short_number(search.t) + " s. Click a setting to use it.";
  if (search.seconds < 0.99 * search.goal.seconds)
    words +=
        " The time is this short because fine runs of a whole second of this cloth would take too long, and no contact "
        "or tear follows in the rest of that second.";
  if (search.present && std::isfinite(search.present->error_rms_m))
    words += (same_settings(search.of, now) ? " Now" : " Before, with " + setting_words(search.of)) + ": error " +
             quantity(search.present->error_rms_m, "m", 2) + ", " + quantity(search.present->cost, "s", 2) +
             " of CPU time per simulated second.";
  return words;
}

float settings_finder_at_1(const Ui& ui, float width) {
  return ui.plots.finder_needs.value_or(finder_at_1 + (find_below(ui, width) ? finder_button_at_1 : 0));
}

void settings_finder(Ui& ui, float) {
  const float begin = ImGui::GetCursorScreenPos().y;
  target_row(ui);
  finder_part(ui);
  const float needs = std::ceil((ImGui::GetCursorScreenPos().y - begin) / ui.theme.scale);
  if (needs == ui.plots.finder_needs) return;
  // What was asked for and has come is to be seen, and no room is left below it.
  if (ui.plots.finder_needs && needs > *ui.plots.finder_needs) ui.plots.wanted = card_name::accuracy;
  ui.plots.finder_needs = needs, ui.draw_by = ui.now;
}

}  // namespace tyglab
