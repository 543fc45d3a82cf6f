#include "app/ui/cards/cards.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/text.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/state/ui.h"
#include "core/integrators/scheme.h"

namespace tyglab {
namespace {

constexpr const char* heading = card_name::copies;
constexpr float line_at_1 = 24, buttons_at_1 = 34, under_words_at_1 = 12;  // pixels at scale 1
constexpr float cost_at_1 = 56, apart_at_1 = 84, remove_at_1 = 26;         // columns
constexpr float beside_from_at_1 = 262;                                    // in a narrower card names stand above
constexpr float menu_at_1 = 300;                                           // its greatest height
constexpr const char* copies_explanation =
    "Copies run alongside this cloth with the same start, hand and wind, each with another method, dt or constant. "
    "Compare their motions.";
constexpr const char* add_label = "Add a copy with…";
constexpr std::array<const char*, 2> copies_ways{"Split view", "Overlaid"};

/// Not where even below the names there is no room for them.
bool costs_shown(const Ui& ui) {
  return plot_card_inner_width(ui, ui.plots.width) >= ui.theme.px(cost_at_1 + apart_at_1 + remove_at_1);
}

/// Where names have no room beside the numbers they stand above them.
bool names_above(const Ui& ui, float width) {
  return plot_card_inner_width(ui, width) < ui.theme.px(beside_from_at_1);
}
float line_height_at_1(const Ui& ui, float width) {
  return names_above(ui, width) ? 2 * line_at_1 - 6 : line_at_1;
}

/// Whether the two buttons have no room in one row of a card of that width.
bool buttons_wrap(const Ui& ui, float width) {
  const float add = text_width(*ui.fonts.text, add_label) + 2 * ImGui::GetStyle().FramePadding.x;
  return add + ui.theme.px(10) + segments_size(ui, copies_ways.data(), 2).x > plot_card_inner_width(ui, width);
}

float explanation_height(const Ui& ui, float width) {
  const ImFont& font = *ui.fonts.text;
  return font.CalcTextSizeA(font.FontSize, 1e9f, plot_card_inner_width(ui, width), copies_explanation).y;
}

/// What a copy may be made with; constants offer the same in their own menus.
void copy_menu(Ui& ui) {
  if (!begin_menu(ui, "copy menu", ui.theme.px(menu_at_1))) return;
  std::string_view group;
  for (const CopyChoice& choice : copy_choices(ui.session.preset())) {
    if (std::exchange(group, choice.group) != choice.group) menu_heading(ui, choice.group);
    if (ImGui::MenuItem(choice.label.c_str()))
      ui.session.request(request::AddCopy{choice.differences, choice.reference});
    report_control(ui, choice.label);
  }
  more_below(ui);
  end_menu();
}

/// Where a row's columns end, pixels from the left; `tail`: what stands to the right of the names.
struct Columns {
  float cost, apart, whole;
};

Columns columns_of(const Ui& ui) {
  const float whole = card_width(ui), apart = whole - ui.theme.px(remove_at_1);
  return {apart - ui.theme.px(apart_at_1), apart, whole};
}

void right_aligned(Ui& ui, const ImFont& font, float x, float middle, ImU32 color, const std::string& text) {
  draw_on_baseline(*ImGui::GetWindowDrawList(), font, {x - text_width(font, text), baseline_at(ui.fonts, middle)},
                   color, text);
}

/// What a column holds, from `lo` to `right`, and under the pointer what that means.
void column_head(Ui& ui, const char* id, ImVec2 lo, float right, const char* words, const char* meaning) {
  const float height = ui.theme.px(card::line);
  right_aligned(ui, *ui.fonts.small, right, lo.y + height / 2, ui.theme.colors.quiet, words);
  ImGui::SetCursorScreenPos(lo);
  gui::press_area(id, {right - lo.x, height});
  report_control(ui, id);
  tooltip(ui, gui::item_id(), meaning);
}

void head(Ui& ui) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const Columns at = columns_of(ui);
  if (costs_shown(ui))
    column_head(ui, "cost", {lo.x + at.cost - ui.theme.px(cost_at_1), lo.y}, lo.x + at.cost, "CPU time",
                "CPU seconds per simulated second (s/s), on the thread that makes the steps. Time of other programs "
                "does not count, except with OpenCL.");
  column_head(
      ui, "distance", {lo.x + at.apart - ui.theme.px(apart_at_1), lo.y}, lo.x + at.apart, "distance, m",
      "Root mean square (rms) of the distances between the particles of this cloth and those of the reference.");
  ImGui::SetCursorScreenPos(lo);
  ImGui::Dummy({at.whole, ui.theme.px(card::line)});
}

std::string number_or_dash(double value) {
  return std::isfinite(value) ? short_number(value, 2) : "–";
}

/// What a click on a cloth's line does: it becomes the reference, or where it has diverged that tells why, since from
/// it nothing can be measured any more.
void choose_cloth(Ui& ui, int n) {
  Copies& copies = ui.session.copies;
  if (cloth_of(ui.session, n).divergence()) return ui.show_why_diverged(n);
  if (copies.reference != n) copies.reference = n, copies.forget();
}

std::string tip_of(const Ui& ui, int n) {
  const std::string settings = settings_of_cloth(ui.session, n);
  if (const auto& divergence = cloth_of(ui.session, n).divergence())
    return settings + ": diverged at t = " + time_number(divergence->t, cloth_of(ui.session, n).preset().dt) +
           " s. Click to see why.";
  return settings + (ui.session.copies.reference == n ? ": the reference, from which distances are measured."
                                                      : ". Click to measure distances from this one.");
}

/// A cloth: its line, its name, what a simulated second costs, how far it is from the reference.
void cloth_line(Ui& ui, int n) {
  Copies& copies = ui.session.copies;
  const Tokens& c = ui.theme.colors;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const Columns at = columns_of(ui);
  const bool above = names_above(ui, ui.plots.width);
  const float height = ui.theme.px(line_height_at_1(ui, ui.plots.width)), sample = ui.theme.px(22);
  const float name_middle = std::round(lo.y + ui.theme.px(line_at_1) / 2),
              middle = above ? std::round(lo.y + height - ui.theme.px(line_at_1) / 2) : name_middle;
  ImGui::PushID(n);
  if (gui::press_area("cloth", {at.apart, height})) choose_cloth(ui, n);
  report_control(ui, n == Copies::original ? "original" : "copy" + std::to_string(n));
  const bool hovered = ImGui::IsItemHovered();
  tooltip(ui, gui::item_id(), tip_of(ui, n));
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  if (hovered) draw.AddRectFilled(lo, {lo.x + at.apart, lo.y + height}, c.field, ui.theme.px(4));
  const ImVec2 ends[2] = {{lo.x, name_middle}, {lo.x + sample, name_middle}};
  draw_styled_line(draw, ends, 2, cloth_style(ui.theme.colors, ui.session, n), ui.theme.scale);
  const bool diverged = cloth_of(ui.session, n).divergence().has_value();
  const float left = lo.x + sample + ui.theme.px(6),
              room = above ? at.apart - sample - ui.theme.px(6)
                           : lo.x + at.cost - (costs_shown(ui) ? ui.theme.px(cost_at_1) : 0) - left;
  draw_on_baseline(draw, *ui.fonts.small, {left, baseline_at(ui.fonts, name_middle)}, diverged ? c.danger : c.text,
                   fitted(*ui.fonts.small, name_of_cloth(ui.session, n), room));
  const Lockstep::Cost& cost = n == Copies::original ? copies.cost : copies.lockstep[std::size_t(n)].cost;
  if (costs_shown(ui))
    right_aligned(ui, *ui.fonts.mono, lo.x + at.cost, middle, c.text,
                  cost.per_second() > 0 && !diverged ? number_or_dash(cost.per_second()) : "–");
  const double apart = copies.distance.empty() ? NAN : copies.distance.column(std::size_t(n + 1)).back();
  right_aligned(ui, *ui.fonts.mono, lo.x + at.apart, middle, diverged ? c.danger : c.text,
                diverged                ? "diverged"
                : n == copies.reference ? "reference"
                                        : number_or_dash(apart));
  if (n != Copies::original) {
    ImGui::SetCursorScreenPos({lo.x + at.whole - ui.theme.px(22), lo.y + ui.theme.px(1)});
    if (quiet_button(ui, "remove", icon::close, "×", "Remove this copy"))
      ui.session.request(request::RemoveCopy{std::size_t(n)});
    report_control(ui, "remove" + std::to_string(n));
  }
  ImGui::PopID();
  ImGui::SetCursorScreenPos({lo.x, lo.y + height});
}

void buttons(Ui& ui, bool any) {
  const bool wrap = buttons_wrap(ui, ui.plots.width);
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  ImGui::SetCursorScreenPos({lo.x, lo.y + ui.theme.px(3)});
  if (text_button(ui, add_label, !any)) ImGui::OpenPopup("copy menu");
  report_control(ui, "add");
  copy_menu(ui);
  if (any) {
    const float right = ImGui::GetItemRectMax().x + ui.theme.px(10);
    ImGui::SetCursorScreenPos(wrap ? ImVec2(lo.x, lo.y + ui.theme.px(buttons_at_1 + 3))
                                   : ImVec2(right, lo.y + ui.theme.px(4)));
    if (const int k = segments(ui, "ways", copies_ways.data(), 2, ui.session.copies.overlaid);
        k >= 0 && (k == 1) != ui.session.copies.overlaid) {
      ui.session.copies.overlaid = k == 1;
      ui.scene.redraw = true;
    }
    report_control(ui, "ways");
  }
  ImGui::SetCursorScreenPos({lo.x, lo.y + ui.theme.px(any && wrap ? 2 * buttons_at_1 : buttons_at_1)});
}

}  // namespace

void copies_plot(Ui& ui, ImVec2 size) {
  Copies& copies = ui.session.copies;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  static constexpr const char* quantities[] = {"Distance", "Energy"};
  const bool energy = copies.plotted == Copies::Quantity::energy;
  if (const int k = segments(ui, "plotted", quantities, 2, energy); k >= 0) copies.plotted = Copies::Quantity(k);
  report_control(ui, "plotted");
  const Series& series = energy ? copies.energy : copies.distance;
  std::vector<std::string> names;
  std::vector<PlotCurve> curves;
  for (int n = Copies::original; n < int(copies.lockstep.size()); ++n) names.push_back(name_of_cloth(ui.session, n));
  for (int n = Copies::original; n < int(copies.lockstep.size()); ++n)
    if (energy || n != copies.reference)
      curves.push_back({names[std::size_t(n + 1)], cloth_style(ui.theme.colors, ui.session, n), series.t(),
                        series.column(std::size_t(n + 1))});
  for (PlotCurve& curve : curves) curve.gaps = series.gaps();
  PlotFrame frame = time_frame(ui, series, !energy, energy ? "J" : "m", why_empty(ui));
  frame.from_zero = false;
  const float used = ui.theme.px(34);
  if (size.y - used < ui.theme.px(40)) return;
  ImGui::SetCursorScreenPos({lo.x, lo.y + used});
  zoom_time(ui, frame, draw_plot(ui, "plot", {size.x, size.y - used}, curves, frame));
}

float copies_card_height(const Ui& ui, float width) {
  const std::size_t copies = ui.session.copies.lockstep.size();
  if (copies == 0)
    return card_height(ui, heading, explanation_height(ui, width) / ui.theme.scale + under_words_at_1 + buttons_at_1);
  const float buttons = buttons_wrap(ui, width) ? 2 * buttons_at_1 : buttons_at_1;
  return card_height(ui, heading, card::line + line_height_at_1(ui, width) * float(copies + 1) + buttons);
}

void copies_card(Ui& ui, float height) {
  if (begin_card(ui, heading, height)) {
    Copies& copies = ui.session.copies;
    const bool any = !copies.lockstep.empty();
    if (any) {
      head(ui);
      for (int n = Copies::original; n < int(copies.lockstep.size()); ++n) cloth_line(ui, n);
    } else {
      ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + card_width(ui));
      wrapped(ui, copies_explanation, ui.theme.colors.text);
      ImGui::PopTextWrapPos();
      ImGui::Dummy({0, ui.theme.px(6)});
    }
    buttons(ui, any);
  }
  end_card(ui);
}

}  // namespace tyglab
