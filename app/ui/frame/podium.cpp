// Presentation mode's few controls, below a large cloth: what a lecture needs at hand. All else is a key away.
#include <algorithm>
#include <string>

#include "app/base/numbers.h"
#include "app/ui/constants/constant_row.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/constants/stability_row.h"
#include "app/ui/frame/panels.h"
#include "app/ui/frame/transport.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float podium_margin_at_1 = 10, podium_gap_at_1 = 18, podium_content_at_1 = 62;  // pixels at scale 1
constexpr float podium_button_at_1 = 38;                                                  // side of the buttons
constexpr float podium_column_at_1 = 250;                                                 // of a column of constants

/// The large buttons, and under them the time.
void large_transport(Ui& ui, ImVec2 at) {
  const ImVec2 hi = transport_buttons(ui, at, podium_button_at_1);
  ui.tour.transport = {{at.x, at.y}, {hi.x, hi.y}};
  const ImFont& mono = *ui.fonts.mono;
  const std::string time = "t = " + time_number(ui.session.simulation->time(), ui.session.preset().dt) + " s";
  const float baseline = baseline_at(ui.fonts, (hi.y + at.y + ui.theme.px(podium_content_at_1)) / 2);
  draw_on_baseline(*ImGui::GetWindowDrawList(), mono, {at.x, baseline}, ui.theme.colors.text,
                   fitted(mono, time, hi.x - at.x));
  const RealTime real = real_time(ui);
  const std::string after = "× " + real.text;
  const float left = std::max(at.x + text_width(mono, time) + ui.theme.px(10), hi.x - text_width(mono, after));
  if (left + text_width(mono, after) > hi.x + ui.theme.px(podium_gap_at_1 - 4)) return;
  ImGui::SetCursorScreenPos({left, hi.y});
  ImGui::InvisibleButton("real_time", {text_width(mono, after), ui.theme.px(podium_content_at_1 - podium_button_at_1)});
  report_control(ui, "real_time");
  tooltip(ui, gui::item_id(), real_time_tip);
  draw_on_baseline(*ImGui::GetWindowDrawList(), mono, {left, baseline}, real.color, after);
}

/// Rows below each other, as wide as they are in the column of constants.
template <class Rows>
void podium_column(Ui& ui, const char* id, ImVec2 at, float width, const Rows& rows) {
  ImGui::SetCursorScreenPos(at);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(ui.theme.px(8), ui.theme.px(2)));
  gui::begin_child(id, {width, ui.theme.px(podium_content_at_1 + podium_margin_at_1)});
  ui.row_width = width - ui.theme.px(4);
  rows();
  ImGui::EndChild();
  ImGui::PopStyleVar();
}

void podium_buttons(Ui& ui, ImVec2 at) {
  ImGui::SetCursorScreenPos(at);
  if (icon_button(ui, {"present", icon::screen, "Panels", "Back to all panels", "F5", true, 28})) ui.command("present");
  ImGui::SetCursorScreenPos({at.x, at.y + ui.theme.px(34)});
  if (icon_button(
          ui, {"card", icon::picture, "Card", ui.presented_card ? "Hide the card" : "Show a card beside the cloth", "",
               ui.presented_card, 28}))
    ui.act([](Ui& u) { u.presented_card = !u.presented_card; });
}

}  // namespace

float podium_height(const Ui& ui) {
  return ui.theme.px(podium_content_at_1 + 2 * podium_margin_at_1);
}

void podium(Ui& ui, const Region& region) {
  if (!begin_region("podium", region, ui.theme.colors.panel, {0, 0})) return end_region();
  const float margin = ui.theme.px(podium_margin_at_1 + 2), gap = ui.theme.px(podium_gap_at_1);
  const float top = region.at.y + ui.theme.px(podium_margin_at_1), end = region.at.x + region.size.x - margin;
  float x = region.at.x + margin;
  large_transport(ui, {x, top});
  x += transport_size(ui, podium_button_at_1).x + gap;
  const float right = end - ui.theme.px(28);
  podium_buttons(ui, {right, top});

  // What has no room is left out, the speeds first, then the stiffness.
  const float least = ui.theme.px(podium_column_at_1);
  float room = right - gap - x;
  const float speed_room = ui.theme.px(100);  // two rows of two
  const float speed = speed_control_size(ui, speed_room).x;
  if (room >= speed + 2 * least + 2 * gap) {
    speed_control(ui, {x, top}, speed_room);
    x += speed + gap, room -= speed + gap;
  }
  const bool both = room >= 2 * least + gap;
  const float width = both ? (room - gap) / 2 : room;
  const bool weight = ui.session.requested_preset().kind == Kind::one_weight;
  if (both) {
    podium_column(ui, "stiffness", {x, top}, width, [&] {
      constant_row(ui, *find_row(weight ? "k" : "k_s"));
      integrator_row(ui);
    });
    x += width + gap;
  }
  podium_column(ui, "step", {x, top}, width, [&] {
    constant_row(ui, *find_row("dt"));
    stability_row(ui);
  });
  end_region();
}

}  // namespace tyglab
