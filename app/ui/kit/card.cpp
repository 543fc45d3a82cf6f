// Cards: lines under a heading that folds them.
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

constexpr float padding_at_1 = 12, top_at_1 = 4;  // pixels at scale 1

}  // namespace

float card_height(const UiContext& ui, const char* heading, float content) {
  const bool folded = ui.settings.layout.folded.count(heading) != 0;
  return ui.theme.px(folded ? card::head : card::head + content + card::foot);
}

float card_width(const UiContext& ui) {
  return card_width(ui, ImGui::GetWindowWidth());
}

float card_width(const UiContext& ui, float width) {
  return width - 2 * ui.theme.px(padding_at_1);
}

bool begin_card(UiContext& ui, const char* heading, float height, std::string_view note) {
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::GetWindowDrawList()->AddRectFilled(lo, {lo.x + width, lo.y + height}, ui.theme.colors.panel, ui.theme.px(8));
  gui::begin_child(heading, {width, height});
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, ImVec2(0, 0));
  ImGui::Dummy({0, ui.theme.px(top_at_1)});
  ImGui::Indent(ui.theme.px(padding_at_1));
  const float row_width = ui.row_width;
  ui.row_width = card_width(ui);  // a section is as wide as its panel's rows
  const bool open = section(ui, heading, note);
  ui.row_width = row_width;
  if (open) ImGui::Dummy({0, ui.theme.px(top_at_1)});
  return open;
}

void end_card(UiContext& ui) {
  ImGui::Unindent(ui.theme.px(padding_at_1));
  ImGui::PopStyleVar();
  ImGui::EndChild();
}

}  // namespace tyglab
