// The few controls of presentation mode, below a large cloth. Everything else needs one key.
#include <algorithm>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float podium_margin_at_1 = 10, podium_gap_at_1 = 18, podium_content_at_1 = 62;  // pixels at scale 1
constexpr float podium_button_at_1 = 38;                                                  // side of the buttons
constexpr float podium_column_at_1 = 250;                                                 // of a column of constants
constexpr float podium_speeds_at_1 = 100;                                                 // of the speeds, two in a row

float transport_end(const Ui& ui, float left) {
  return left + ui.theme.px(podium_margin_at_1 + 2) + transport_size(ui, podium_button_at_1).x +
         ui.theme.px(podium_gap_at_1);
}

/// Between the transport and the buttons at the right, px.
float middle_room(const Ui& ui, float width) {
  return width - transport_end(ui, 0) - ui.theme.px(podium_margin_at_1 + 2 + 28 + podium_gap_at_1);
}

float speeds_width(const Ui& ui) {
  return speed_control_size(ui, ui.theme.px(podium_speeds_at_1)).x;
}

bool room_for_speeds(const Ui& ui, float width) {
  return middle_room(ui, width) >= speeds_width(ui) + 2 * ui.theme.px(podium_column_at_1 + podium_gap_at_1);
}

/// The time, and how near it runs to real time, from `at` to x = end.
void time_line(Ui& ui, ImVec2 at, float end) {
  const ImFont& mono = *ui.fonts.mono;
  const float height = ui.theme.px(podium_content_at_1 - podium_button_at_1);
  const std::string time = "t = " + time_number(ui.session.simulation->time(), ui.session.preset().dt) + " s";
  const float baseline = baseline_at(ui.fonts, at.y + height / 2);
  draw_on_baseline(*ImGui::GetWindowDrawList(), mono, {at.x, baseline}, ui.theme.colors.text,
                   fitted(mono, time, end - at.x));
  const RealTime real = real_time(ui);
  if (!real.known) return;
  const std::string& after = real.text;
  const float left = std::max(at.x + text_width(mono, time) + ui.theme.px(10), end - text_width(mono, after));
  if (left + text_width(mono, after) > end + ui.theme.px(podium_gap_at_1 - 4)) return;
  ImGui::SetCursorScreenPos({left, at.y});
  gui::press_area("real_time", {text_width(mono, after), height});
  report_control(ui, "real_time");
  tooltip(ui, gui::item_id(), real_time_tip);
  draw_on_baseline(*ImGui::GetWindowDrawList(), mono, {left, baseline}, real.color, after);
}

/// The large buttons, and under them the time or, where the speeds have no room beside them, those.
void large_transport(Ui& ui, ImVec2 at, bool speeds_below) {
  const ImVec2 hi = transport_buttons(ui, at, podium_button_at_1);
  ui.tour.transport = {{at.x, at.y}, {hi.x, hi.y}};
  if (!speeds_below) return time_line(ui, {at.x, hi.y}, hi.x);
  const ImVec2 list = speed_list_size(ui);
  speed_list(ui, {at.x, hi.y + ui.theme.px(podium_content_at_1 - podium_button_at_1) - list.y + ui.theme.px(6)});
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

/// Beside dt: the constants that the lab's step asks for, or else the stiffness.
std::vector<const PresetRow*> constants_at_hand(const Ui& ui) {
  constexpr std::size_t most = 2;  // rows of a column
  std::vector<const PresetRow*> rows = checked_constants(ui);
  std::erase_if(rows, [](const PresetRow* row) { return row->key == "dt"; });
  if (rows.size() > most) rows.resize(most);
  if (rows.empty()) rows.push_back(find_row(ui.session.requested_preset().kind == Kind::one_weight ? "k" : "k_s"));
  return rows;
}

void podium_buttons(Ui& ui, ImVec2 at, bool with_card) {
  ImGui::SetCursorScreenPos(at);
  if (icon_button(ui, {"present", icon::screen, "Panels", "Back to all panels", "F5 or Esc", true, 28}))
    ui.command("present");
  if (!with_card) return;
  ImGui::SetCursorScreenPos({at.x, at.y + ui.theme.px(34)});
  if (icon_button(
          ui, {"card", icon::picture, "Card", ui.presented_card ? "Hide the card" : "Show a card beside the cloth", "",
               ui.presented_card, 28}))
    ui.act([](Ui& u) { u.presented_card = !u.presented_card; });
}

}  // namespace

bool time_on_podium(const Ui& ui, float width) {
  return room_for_speeds(ui, width);
}

float podium_height(const Ui& ui) {
  return ui.theme.px(podium_content_at_1 + 2 * podium_margin_at_1);
}

void podium(Ui& ui, const Region& region) {
  if (!begin_region("podium", region, ui.theme.colors.panel, {0, 0})) return end_region();
  const float margin = ui.theme.px(podium_margin_at_1 + 2), gap = ui.theme.px(podium_gap_at_1), width = region.size.x;
  const float top = region.at.y + ui.theme.px(podium_margin_at_1);
  const bool speeds = room_for_speeds(ui, width);
  large_transport(ui, {region.at.x + margin, top}, !speeds);
  podium_buttons(ui, {region.at.x + width - margin - ui.theme.px(28), top},
                 presented_card_width(ui, width) > 0 && !(ui.session.labs.run && lab_column_width(ui, width) > 0));

  // What has no room is left out or made smaller, the speeds first, then the stiffness or what a lab asks for.
  float x = transport_end(ui, region.at.x), room = middle_room(ui, width);
  const float least = ui.theme.px(podium_column_at_1);
  if (speeds) {
    speed_control(ui, {x, top}, ui.theme.px(podium_speeds_at_1));
    x += speeds_width(ui) + gap, room -= speeds_width(ui) + gap;
  }
  const bool both = room >= 2 * least + gap;
  const float column = both ? (room - gap) / 2 : room;
  const std::vector<const PresetRow*> rows = constants_at_hand(ui);
  const bool lab_alone = !both && ui.session.labs.run.has_value();
  if (both) {
    podium_column(ui, "stiffness", {x, top}, column, [&] {
      for (const PresetRow* row : rows) constant_row(ui, *row);
      if (rows.size() == 1) integrator_row(ui);
    });
    x += column + gap;
  }
  podium_column(ui, "step", {x, top}, column, [&] {
    constant_row(ui, *find_row("dt"));
    lab_alone ? constant_row(ui, *rows.front()) : stability_row(ui);
  });
  end_region();
}

}  // namespace tyglab
