#include "app/ui/constants/stability_row.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "app/base/numbers.h"
#include "app/ui/constants/constant_row.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr double full = 1.5;  // of the limit, at the bar's right end
constexpr double near_limit = 0.9;

ImU32 color_of(const Tokens& c, double part) {
  return part > 1 ? c.danger : part > near_limit ? c.warning : c.good;
}

std::string two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 10 ? "%.2f" : "%.3g", value);
  return text;
}

void draw_gauge(Ui& ui, const StabilityLimits& limits, ImVec2 lo, ImVec2 hi) {
  const Tokens& c = ui.theme.colors;
  const double part = ui.session.requested_preset().dt / limits.any;
  const float rounding = ui.theme.px(3), width = hi.x - lo.x;
  const auto at = [&](double of) { return lo.x + width * float(std::clamp(of / full, 0.0, 1.0)); };
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(lo, hi, c.field, rounding);
  draw.AddRectFilled(lo, {std::max(at(part), lo.x + 2 * rounding), hi.y}, color_of(c, part), rounding);
  const float reach = ui.theme.px(3), line = ui.theme.px(2);
  draw.AddLine({at(1), lo.y - reach}, {at(1), hi.y + reach}, c.text, line);
  if (limits.now && *limits.now > 0 && *limits.now < full * limits.any)
    draw.AddCircleFilled({at(*limits.now / limits.any), (lo.y + hi.y) / 2}, ui.theme.px(3), c.text, 16);
}

/// "auto" where other rows have their unit: dt follows the constants.
void auto_toggle(Ui& ui, ImVec2 at, float width, float height) {
  const Tokens& c = ui.theme.colors;
  const ImFont& font = *ui.fonts.small;
  const bool on = ui.session.auto_dt.has_value();
  const ImVec2 after = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos(at);
  if (ImGui::InvisibleButton("auto", {width, height})) ui.command("toggle_auto");
  report_control(ui, "auto");
  const bool hovered = ImGui::IsItemHovered();
  tooltip(ui, gui::item_id(),
          on ? "dt is chosen by the program: 0.8 of what is stable in any configuration, less if the ledger finds "
               "that the method adds energy. Click to keep the present dt."
             : "Let the program choose and adjust dt: 0.8 of what is stable in any configuration, less if the "
               "ledger finds that the method adds energy.");
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

std::string stability_text(const StabilityLimits& limits, double dt) {
  if (std::isinf(limits.any)) return "no limit";
  return limits.any > 0 ? two_digits(dt / limits.any) : "always above";
}

std::string stability_words(const StabilityLimits& limits, double dt) {
  if (chooses_steps(scheme(limits.of.integrator)))
    return "This method chooses its own steps within dt, as short as stability and tolerance require.";
  if (std::isinf(limits.any))
    return "Linear theory sets no largest dt for this method. Bodies, and springs that switch, still can.";
  if (limits.any == 0) return "No dt is stable: without more damping this method feeds energy into every oscillation.";
  std::string text = "dt is " + two_digits(dt / limits.any) + " of the largest that is stable in any configuration, " +
                     short_number(limits.any) + " s.";
  if (limits.now && *limits.now > 0 && std::isfinite(*limits.now))
    text += " As the cloth hangs now (dot), " + short_number(*limits.now) +
            " s: its fastest mode has ω = " + short_number(limits.omega) + " 1/s.";
  if (std::isfinite(limits.stiffness) && limits.stiffness > 0 && limits.of.kind == Kind::cloth)
    text += " With this dt, springs " + two_digits(limits.stiffness) + " times as stiff would reach the limit" +
            (limits.of.k_b == 0 ? ": k_s = " + short_number(limits.stiffness * limits.of.k_s) + " N/m." : ".");
  return text + " One-sided springs switch, so this is a guide, not a guarantee.";
}

void stability_row(Ui& ui) {
  const auto& limits = ui.session.studies.stability.limits();
  labeled_row(ui, "limit", [&](float width) {
    const RowColumns columns = row_columns(ui);
    const ImVec2 lo = ImGui::GetCursorScreenPos();
    const float height = ui.theme.px(30);  // as the labels of such rows are placed
    ImGui::Dummy({width, height});
    report_control(ui, "stability");
    const bool wants_words = tooltip_due(ui, ImGui::GetID("stability"));
    auto_toggle(ui, {lo.x + width - columns.unit, lo.y}, columns.unit, height);
    if (!limits) return;
    const Tokens& c = ui.theme.colors;
    const double dt = ui.session.requested_preset().dt;
    const bool bounded = limits->any > 0 && std::isfinite(limits->any);
    const float bar = width - columns.value - columns.unit - 2 * columns.gap, middle = lo.y + height / 2;
    const float half = ui.theme.px(4);
    const std::string text = stability_text(*limits, dt);
    const float right = lo.x + bar + columns.gap + columns.value;
    if (bounded) draw_gauge(ui, *limits, {lo.x, middle - half}, {lo.x + bar, middle + half});
    const ImFont& font = bounded ? *ui.fonts.mono : *ui.fonts.small;
    const float x = bounded ? right - ui.theme.px(6) - text_width(font, text) : lo.x;
    draw_on_baseline(*ImGui::GetWindowDrawList(), font, {x, baseline_at(ui.fonts, middle)},
                     bounded            ? color_of(c, dt / limits->any)
                     : limits->any == 0 ? c.danger
                                        : c.quiet,
                     text);
    if (wants_words) tooltip(ui, ImGui::GetID("stability"), stability_words(*limits, dt));
  });
}

}  // namespace tyglab
