// The regions of the window: top bar, constants, viewport, plots, status. Their borders can be dragged.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "app/ui/cards/cards.h"
#include "app/ui/constants/constants_panel.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

// Pixels at scale 1.
constexpr float least_plots = 180;      // height of their column beside a lab's strip
constexpr float low_with_lab = 300;     // a lab's strip takes the status line's place in a window lower than that
constexpr float narrowest_cloth = 240;  // beside both columns
constexpr float wide_strip = 544;       // of a lab: in two columns
constexpr float least_constants = 240;  // width of their column beside a lab's
constexpr float tabs_at_1 = 42;         // height of what chooses between columns

/// A border that drags: changes `width` (at scale 1) of the region on its left (sign 1) or right (sign -1).
void splitter(Ui& ui, const char* id, float x, float top, float bottom, float& width, float sign) {
  const float grip = ui.theme.px(8);
  const Region region{{x - grip / 2, top}, {grip, bottom - top}};
  ImGui::SetNextWindowPos(region.at);
  ImGui::SetNextWindowSize(region.size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(0, 0));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1, 1));
  if (ImGui::Begin(id, nullptr,
                   (region_flags & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_NoBackground)) {
    gui::press_area("grip", region.size);
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
      ImGui::GetWindowDrawList()->AddLine({x, top}, {x, bottom}, ui.theme.colors.accent, ui.theme.px(2));
    }
    if (ImGui::IsItemActivated()) width = (sign > 0 ? x : ImGui::GetIO().DisplaySize.x - x) / ui.theme.scale;
    if (ImGui::IsItemActive())
      width = std::clamp(width + sign * ImGui::GetIO().MouseDelta.x / ui.theme.scale, 240.f, 900.f);
  }
  ImGui::End();
  ImGui::PopStyleVar(2);
  ui.viewport.covers.push_back({{region.at.x, top}, {region.at.x + grip, bottom}});
}

/// Of a column at the sides, px: `part` of the window at most while nobody has dragged it, so that the cloth has six
/// tenths of a window of 1280 pixels. For a finger sliders must not be short.
float side_width(const Ui& ui, float width_at_1, float usual_at_1, float least_at_1, float part, float window) {
  float width = width_at_1 * ui.theme.scale;
  if (width_at_1 == usual_at_1) width = std::min(width, std::max(part * window, ui.theme.px(least_at_1)));
  return width;
}

/// Where the regions are; what has no width or no height is not there.
struct LayoutPlan {
  Region viewport, lab, top, status, constants, plots, podium;
  Region tabs;                          ///< which choose between columns
  std::vector<Side> turns;              ///< in their order
  bool lab_column = false;              ///< the lab stands beside the cloth
  bool lab_with_constants_tab = false;  ///< below it, with the constants but not with the plots
};

/// Choose what stands in the place that the columns share, or also the cloth where that has no room beside them.
void side_tabs(Ui& ui, const LayoutPlan& plan) {
  if (begin_region("side", plan.tabs, ui.theme.colors.panel, {ui.theme.px(16), ui.theme.px(8)})) {
    std::vector<const char*> names;
    int now = 0;
    for (const Side side : plan.turns) {
      if (side == ui.side) now = int(names.size());
      const char* const constants = plan.lab_with_constants_tab ? "Constants, lab" : "Constants";
      names.push_back(side == Side::plots       ? "Plots"
                      : side == Side::constants ? constants
                      : plan.lab_column         ? "Lab"
                                                : "Cloth");
    }
    if (const int k = segments(ui, "columns", names.data(), int(names.size()), now); k >= 0)
      ui.side = plan.turns[std::size_t(k)];
    if (!plan.lab_column)
      tooltip(ui, gui::item_id(),
              "The window is too narrow for all columns at once; Ctrl+- makes text and panels smaller.");
  }
  end_region();
}

}  // namespace

float presented_card_width(const Ui& ui, float window) {
  const float width = std::round(0.225f * window);
  return width < ui.theme.px(200) ? 0 : width;
}

namespace {

/// The lab beside the cloth, in turn with the plots and, where these have no column, the constants.
void plan_lab_column(const Ui& ui, LayoutPlan& plan, const Region& column, bool with_constants) {
  const float strip = ui.theme.px(tabs_at_1);
  plan.lab_column = true;
  plan.tabs = {column.at, {column.size.x, strip}};
  plan.turns = {Side::main};
  if (with_constants) plan.turns.push_back(Side::constants);
  plan.turns.push_back(Side::plots);
  Region& shown = ui.side == Side::plots                         ? plan.plots
                  : ui.side == Side::constants && with_constants ? plan.constants
                                                                 : plan.lab;
  shown = {{column.at.x, column.at.y + strip}, {column.size.x, std::max(column.size.y - strip, 1.f)}};
}

/// The cloth, below it the few controls, and beside it the lab, or one card where there is room.
LayoutPlan plan_presentation(const Ui& ui, ImVec2 window) {
  LayoutPlan plan;
  const bool lab = ui.session.labs.run.has_value();
  const float low = podium_height(ui), height = std::max(window.y - low, 1.f);
  const float column = lab ? lab_column_width(ui, window.x) : 0;
  const float strip = lab && column == 0 ? lab_strip_height(ui, window.y, height) : 0;
  const float card = ui.presented_card ? presented_card_width(ui, window.x) : 0, right = column > 0 ? column : card;
  plan.viewport = {{0, 0}, {window.x - right, std::max(height - strip, 1.f)}};
  plan.lab = {{0, height - strip}, {window.x - right, strip}};
  plan.podium = {{0, height}, {window.x, low}};
  const Region side{{window.x - right, 0}, {right, height}};
  if (column > 0)
    plan_lab_column(ui, plan, side, false);
  else if (right > 0)
    plan.plots = side;
  return plan;
}

/// Beside the lab's column, which has its text in reading width, come the constants if the cloth keeps enough.
LayoutPlan plan_beside_lab(const Ui& ui, ImVec2 window, float top, float bottom) {
  LayoutPlan plan;
  const Layout& layout = ui.settings.layout;
  const float lab = lab_column_width(ui, window.x), spare = room_beside_cloth(window.x) - lab;
  float left = layout.left ? std::round(std::min(layout.left_width * ui.theme.scale, spare)) : 0;
  if (left < ui.theme.px(least_constants)) left = 0;
  const float middle = window.x - left - lab, height = std::max(window.y - top, 1.f);
  plan.viewport = {{left, top}, {middle, std::max(height - bottom, 1.f)}};
  plan.top = {{0, 0}, {window.x, top}};
  plan.status = {{left, window.y - bottom}, {middle, bottom}};
  plan.constants = {{0, top}, {left, height}};
  plan_lab_column(ui, plan, {{window.x - lab, top}, {lab, height}}, left == 0);
  return plan;
}

LayoutPlan plan_layout(const Ui& ui, ImVec2 window) {
  if (ui.presenting && ui.panels) return plan_presentation(ui, window);
  const Layout& layout = ui.settings.layout;
  const bool panels = ui.panels, has_lab = panels && ui.session.labs.run;
  const float top = panels ? ui.theme.px(48) : 0;
  const bool lab_in_low = has_lab && window.y < ui.theme.px(low_with_lab);
  const float bottom = panels && layout.status && !lab_in_low ? ui.theme.px(30) : 0;
  if (has_lab && lab_column_width(ui, window.x) > 0) return plan_beside_lab(ui, window, top, bottom);
  const float height = std::max(window.y - top - bottom, 1.f);
  // In a narrow window, or with large text, the sides share what the viewport can spare; a lab's strip needs it wide.
  const float least = has_lab ? wide_strip : narrowest_cloth;
  const float spare = window.x - ui.theme.px(least), most = std::max(spare / 2, ui.theme.px(240));
  const Layout usual;
  const float left_width =
      side_width(ui, layout.left_width, usual.left_width, ui.input.by_touch ? 288 : 240, 0.206f, window.x);
  const float right_width = side_width(ui, layout.right_width, usual.right_width, 240, 0.194f, window.x);
  float left = panels && layout.left ? std::floor(std::min(left_width, most)) : 0;
  float right = panels && layout.right ? std::floor(std::min(right_width, most)) : 0;
  // Where both have no room, they take turns in one place.
  const bool shared = left > 0 && left + right > spare;
  if (left + right > spare) right = 0;
  if (shared) left = std::round(std::min(layout.left_width * ui.theme.scale, std::max(spare, left)));
  // Where not even one has room beside the cloth, all three do. For a finger sliders must not be short.
  const bool short_sliders = ui.input.by_touch && left < ui.theme.px(280);
  const bool in_turn = left > 0 && (short_sliders || left + ui.theme.px(200) > window.x);
  if (in_turn) left = ui.side == Side::main ? 0 : window.x;

  float lab = has_lab ? lab_strip_height(ui, window.y, height) : 0;
  const float middle = window.x - left - right, strip = ui.theme.px(tabs_at_1);
  // Where the viewport is too narrow for a lab's two columns, the strip reaches below the constants, which scroll;
  // plots that would be too low above it take its place.
  const bool narrow = middle < ui.theme.px(wide_strip);
  const bool apart = lab > 0 && narrow && (shared || in_turn) && height - lab - strip < ui.theme.px(least_plots);
  if (apart && left > 0 && ui.side == Side::plots) lab = 0;
  const bool below = lab > 0 && left > 0 && narrow;
  const float low = below ? 0 : left, column = window.y - top - (below ? lab + bottom : 0);
  const float over_cloth = in_turn ? strip : 0, tabs = shared || in_turn ? strip : 0;

  LayoutPlan plan;
  plan.lab_with_constants_tab = apart;
  plan.viewport = {{left, top + over_cloth}, {middle, std::max(height - lab - over_cloth, 1.f)}};
  plan.lab = {{low, top + height - lab}, {left + middle - low, lab}};
  plan.top = {{0, 0}, {window.x, top}};
  plan.status = {{low, window.y - bottom}, {left + middle - low, bottom}};
  plan.tabs = {{0, top}, {in_turn ? window.x : left, tabs}};
  if (tabs > 0) plan.turns = {Side::constants, Side::plots};
  if (in_turn) plan.turns.push_back(Side::main);
  const Region side{{0, top + tabs}, {left, column - tabs}};
  (shared && ui.side == Side::plots ? plan.plots : plan.constants) = side;
  if (right > 0) plan.plots = {{window.x - right, top}, {right, window.y - top}};
  return plan;
}

/// A lab's step has its constants with it where no column and no podium shows them.
bool lab_has_constants(const LayoutPlan& plan) {
  return plan.lab.size.y > 0 && plan.constants.size.x <= 0 && plan.podium.size.y <= 0;
}

}  // namespace

void draw_layout(Ui& ui, ImVec2 window) {
  Layout& layout = ui.settings.layout;
  const LayoutPlan plan = plan_layout(ui, window);
  const Region& viewport = plan.viewport;
  const float left = viewport.at.x, right = left + viewport.size.x;
  ui.viewport_left = left;
  ui.lab_field.waits = ui.lab_field.shown = false;
  ui.time_in_picture = plan.podium.size.y > 0 && !time_on_podium(ui, window.x);
  if (viewport.size.x > 0) {
    viewport_panel(ui, viewport);
  } else {
    ui.viewport.box = {};
    ui.viewport.covers.clear();
  }
  if (plan.lab.size.y > 0) lab_panel(ui, plan.lab, plan.lab_column, lab_has_constants(plan));
  if (plan.top.size.y > 0) top_bar(ui, plan.top);
  if (plan.tabs.size.y > 0) side_tabs(ui, plan);
  if (plan.constants.size.x > 0) constants_panel(ui, plan.constants);
  if (plan.plots.size.x > 0) plots_panel(ui, plan.plots);
  if (plan.status.size.y > 0) status_bar(ui, plan.status);
  if (plan.podium.size.y > 0) podium(ui, plan.podium);
  const Region no_status = viewport.size.x > 0 ? Region{{left, viewport.at.y + viewport.size.y}, {viewport.size.x, 0}}
                                               : Region{{0, window.y}, {window.x, 0}};
  message_line(ui, plan.status.size.y > 0 ? plan.status : no_status);
  const float top = plan.top.size.y;
  if (left > 0 && viewport.size.x > 0) {
    const Region& side = plan.constants.size.x > 0 && plan.constants.at.x == 0 ? plan.constants : plan.plots;
    splitter(ui, "left border", left, top, side.at.y + side.size.y, layout.left_width, 1);
  }
  if (right < window.x && plan.podium.size.y == 0 && !plan.lab_column)
    splitter(ui, "right border", right, top, window.y, layout.right_width, -1);
  tour_card(ui);
  help_overlay(ui);
  palette(ui);
  dialogs(ui);
  ui.lab_field.enter = false;
  if (!ui.lab_field.shown) ui.lab_field.again = false;
  ui.viewport.blocked = ui.palette.open || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}

Wants layout_wants(const Ui& ui, ImVec2 window) {
  const LayoutPlan plan = plan_layout(ui, window);
  Wants wants;
  wants = plots_want(ui, plan.plots.size, plan.tabs.size.y > 0);
  if (plan.constants.size.x > 0 || plan.podium.size.y > 0 || lab_has_constants(plan))
    wants.stability = true;  // the gauge under dt, the zones under sliders
  return wants;
}

}  // namespace tyglab
