#include "app/ui/constants/constants_panel.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/base/text.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"
#include "core/theory/advice.h"

namespace tyglab {
namespace {

constexpr double in_times = 1.95;  // from here on a part is said in times rather than in percent

std::string percent(double part) {
  return short_number(rounded(100 * part, part < 1 ? 2 : 3)) + " %";
}

/// "75 % of", "35 times".
std::string part_of(double part) {
  return part < in_times ? percent(part) + " of" : power_number(rounded(part, 2)) + " times";
}

bool has_limit(const StabilityLimits& limits) {
  return limits.any > 0 && std::isfinite(limits.any);
}

/// The cloth's own limit, where it is known and springs act.
std::optional<double> own_limit(const StabilityLimits& limits) {
  const bool cloth = limits.of.kind == Kind::cloth;
  return cloth && limits.now && *limits.now > 0 && std::isfinite(*limits.now) ? limits.now : std::nullopt;
}

/// Which shape of the cloth its own limit belongs to.
std::string when(const StabilityLimits& limits) {
  return limits.at_start ? "at the start" : "as it hangs now";
}

Zone zone_at(const StabilityLimits& limits, double dt) {
  return dt <= limits.any ? Zone::stable : dt <= limits.every ? Zone::depends : Zone::unstable;
}

void draw_gauge(Ui& ui, const StabilityLimits& limits, ImVec2 lo, ImVec2 hi) {
  const Tokens& c = ui.theme.colors;
  const double dt = ui.session.requested_preset().dt;
  const float rounding = ui.theme.px(3), width = hi.x - lo.x, strip = ui.theme.px(5), line = ui.theme.px(2);
  const auto at = [&](double value) { return std::round(lo.x + width * float(gauge_position(limits, value))); };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 foot{hi.x, hi.y - strip};
  draw.AddRectFilled(lo, foot, c.field, rounding);
  draw.AddRectFilled(lo, {std::max(at(dt), lo.x + 2 * rounding), foot.y - line / 2}, zone_color(c, zone_at(limits, dt)),
                     rounding);
  const float any = at(limits.any), every = std::isfinite(limits.every) ? at(limits.every) : hi.x;
  const float top = foot.y + line / 2;
  draw_zone(ui, Zone::stable, {lo.x, top}, {any, hi.y});
  if (every > any) draw_zone(ui, Zone::depends, {any, top}, {every, hi.y});
  if (hi.x > every) draw_zone(ui, Zone::unstable, {every, top}, hi);
  draw.AddLine({any, lo.y - line}, {any, hi.y + line}, c.text, line);
  if (const auto own = own_limit(limits)) {
    const ImVec2 middle{at(*own), (lo.y + foot.y) / 2};
    draw.AddCircleFilled(middle, ui.theme.px(4.5f), c.panel, 16);
    draw.AddCircleFilled(middle, ui.theme.px(3), c.text, 16);
  }
}

/// One target, from `lo` to `hi`, of which the bar takes the left part: near a mark it says what that is, else all,
/// after what else there is to say.
void gauge_tooltips(Ui& ui, const StabilityLimits& limits, double dt, ImVec2 lo, ImVec2 hi, float bar,
                    const std::string& first) {
  const float reach = ui.theme.px(5);
  const auto x_of = [&](const GaugeMark& mark) { return lo.x + bar * float(gauge_position(limits, mark.at)); };
  const std::vector<GaugeMark> marks = gauge_marks(limits, dt);
  if (ui.controls)
    for (const GaugeMark& mark : marks) {
      ImGui::SetCursorScreenPos({x_of(mark) - 1, lo.y});
      ImGui::Dummy({2, hi.y - lo.y});
      report_control(ui, "gauge " + std::string(mark.name));
    }
  ImGui::SetCursorScreenPos(lo);
  gui::press_area("gauge", {hi.x - lo.x, hi.y - lo.y});
  report_control(ui, "stability");
  const float pointer = ImGui::GetIO().MousePos.x;
  const auto off = [&](const GaugeMark& mark) { return std::abs(pointer - x_of(mark)); };
  const auto nearest = std::min_element(marks.begin(), marks.end(),
                                        [&](const GaugeMark& a, const GaugeMark& b) { return off(a) < off(b); });
  if (nearest != marks.end() && off(*nearest) <= reach)
    tooltip(ui, ImGui::GetID(nearest->name.data()), nearest->words);
  else
    tooltip(ui, gui::item_id(), (first.empty() ? "" : first + "\n") + stability_words(limits, dt));
}

/// "auto" where other rows have their unit: dt follows the constants.
void auto_toggle(Ui& ui, ImVec2 at, float width, float height) {
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.small;
  const bool on = ui.session.auto_dt.has_value();
  const ImVec2 after = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos(at);
  if (gui::press_area("auto", {width, height})) ui.command("toggle_auto");
  report_control(ui, "auto");
  const bool hovered = ImGui::IsItemHovered();
  tooltip(ui, gui::item_id(),
          on ? "The program chooses dt: 0.8 of the worst-case limit, less if the ledger finds that the method adds "
               "energy. Click to keep the present dt."
             : "Let the program choose and adjust dt: 0.8 of the worst-case limit, less if the ledger finds that the "
               "method adds energy.");
  const float inset = std::round((height - ui.theme.px(20)) / 2);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled({at.x, at.y + inset}, {at.x + width, at.y + height - inset},
                     on        ? c.accent
                     : hovered ? c.field_hover
                               : c.field,
                     ui.theme.px(4));
  const float x = at.x + (width - text_width(font, "auto")) / 2;
  draw_on_baseline(draw, font, {x, baseline_at(ui.fonts, at.y + height / 2)}, on ? c.on_accent : c.quiet, "auto");
  ImGui::SetCursorScreenPos(after);
}

}  // namespace

double gauge_position(const StabilityLimits& limits, double dt) {
  return dt / (dt + limits.any);
}

std::string stability_text(const StabilityLimits& limits, double dt) {
  if (std::isinf(limits.any)) return "no limit";
  if (limits.any == 0) return "unstable at any dt";
  const double part = dt / limits.any;
  return part < in_times ? percent(part) : power_number(rounded(part, 2)) + " ×";
}

std::string part_words(const StabilityLimits& limits, double dt) {
  if (!has_limit(limits)) return "";
  const bool cloth = limits.of.kind == Kind::cloth;
  std::string text = "dt is " + part_of(dt / limits.any) + " the " + (cloth ? "worst-case limit" : "limit");
  if (const auto own = own_limit(limits)) text += ", " + part_of(dt / *own) + " this cloth's " + when(limits);
  return text + ".";
}

std::vector<GaugeMark> gauge_marks(const StabilityLimits& limits, double dt) {
  std::vector<GaugeMark> marks;
  if (!has_limit(limits)) return marks;
  const bool cloth = limits.of.kind == Kind::cloth;
  const std::string method(scheme(limits.of.integrator).title);
  const auto seconds = [](double value) { return quantity(value, "s", 3); };
  if (const auto own = own_limit(limits))
    marks.push_back({"this cloth", *own,
                     "Dot: this cloth's own limit " + when(limits) + ": " + seconds(*own) +
                         ", from its fastest mode, ω = " + power_number(rounded(limits.omega, 3)) +
                         " 1/s. It changes with the shape and guarantees nothing: slack cloths without damping have "
                         "diverged at 63 % of it."});
  marks.push_back({"worst case", limits.any,
                   cloth ? "Line: the worst-case limit, " + seconds(limits.any) + ". Up to it, " + method +
                               " is stable in any shape of the cloth."
                         : "Line: the limit, " + seconds(limits.any) + ". Above it, " + method + " is unstable."});
  if (cloth && std::isfinite(limits.every))
    marks.push_back({"every shape", limits.every,
                     "Hatched: above " + seconds(limits.every) + ", " + method +
                         " is unstable in every shape in which a spring pulls. Between the line and this value, "
                         "stability depends on the shape."});
  marks.push_back({"dt", dt, "Bar: " + part_words(limits, dt)});
  return marks;
}

std::string stability_words(const StabilityLimits& limits, double dt) {
  if (chooses_steps(scheme(limits.of.integrator)))
    return "This method chooses inner steps within dt, as short as stability and tolerance require.";
  if (counts_passes(scheme(limits.of.integrator)))
    return "Linear theory sets no largest dt for this method once its passes converge. Few passes may add energy, and "
           "so may bodies and springs that switch.";
  if (std::isinf(limits.any))
    return "Linear theory sets no largest dt for this method, but bodies and springs that switch may.";
  if (limits.any == 0) return "No dt is stable: without more damping, this method adds energy to every oscillation.";
  const std::string name(zone_name(zone_at(limits, dt), limits.of.kind));
  std::string text = char(name.front() - 'a' + 'A') + name.substr(1) + ": " + part_words(limits, dt);
  for (const GaugeMark& mark : gauge_marks(limits, dt))
    if (mark.name != "dt") text += "\n" + mark.words;
  return text + "\nThis is linear theory: springs that switch make it a guide, not a guarantee.";
}

void stability_row(Ui& ui) {
  const auto& limits = ui.session.studies.stability.limits();
  labeled_row(ui, "dt/limit", [&](float width) {
    const RowColumns columns = row_columns(ui);
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    const float height = ui.theme.px(30);  // as the labels of such rows are placed
    auto_toggle(ui, {lo.x + width - columns.unit, lo.y}, columns.unit, height);
    if (!limits) return;
    const Tokens& c = ui.theme.colors;
    const double dt = ui.session.requested_preset().dt;
    const bool bounded = has_limit(*limits);
    const float bar = width - columns.value - columns.unit - 2 * columns.gap, middle = lo.y + height / 2;
    const std::string coarse = precision_too_coarse(ui.session.requested_preset());
    const std::string text = coarse.empty() || bounded ? stability_text(*limits, dt)
                                                       : std::string(name_of(limits->of.precision)) + " too coarse";
    const float right = lo.x + bar + columns.gap + columns.value;
    const float half = ui.theme.px(7);
    if (bounded) draw_gauge(ui, *limits, {lo.x, middle - half}, {lo.x + bar, middle + half});
    const ImFont& font = bounded ? *ui.fonts.mono : *ui.fonts.small;
    const float x = bounded ? right - ui.theme.px(6) - text_width(font, text) : lo.x;
    draw_on_baseline(*ImGui::GetWindowDrawList(), font, {x, baseline_at(ui.fonts, middle)},
                     !coarse.empty()    ? c.warning
                     : bounded          ? zone_color(c, zone_at(*limits, dt))
                     : limits->any == 0 ? c.danger
                                        : c.quiet,
                     text);
    gauge_tooltips(ui, *limits, dt, lo, {right, lo.y + height}, bar, coarse);
  });
}

}  // namespace tyglab
