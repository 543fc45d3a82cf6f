#include "app/ui/kit/widgets.h"

#include <algorithm>

#include "app/ui/kit/imgui_compat.h"

namespace tyglab {
namespace {

constexpr float tab_roomy = 11, tab_narrow = 4;  // pixels at scale 1 to both sides of a name
constexpr float tab_one_row_at_1 = 26, tab_two_rows_at_1 = 56;
constexpr float tab_rows_from_at_1 = 300;  // a lower column has no height to spare for a second row

}  // namespace

CardTabs::CardTabs(const UiContext& ui, std::span<const char* const> names, ImVec2 column)
    : names_(names), width_(column.x), padding_(tab_roomy) {
  const auto size = [&](float width) { return segments_size(ui, names.data(), int(names.size()), padding_, width); };
  if (size(1e9f).x > width_) padding_ = tab_narrow;
  const ImVec2 rows = size(width_);
  list_ = rows.x > width_ || rows.y > ui.theme.px(tab_two_rows_at_1 + 1) ||
          (rows.y > ui.theme.px(tab_one_row_at_1) && column.y < ui.theme.px(tab_rows_from_at_1));
  height_ = list_ ? ImGui::GetFontSize() + 2 * ui.theme.px(6) : rows.y;
}

int CardTabs::draw(UiContext& ui, int chosen) const {
  if (!list_) {
    const int clicked = segments(ui, "cards", names_.data(), int(names_.size()), chosen, padding_, width_);
    report_control(ui, "cards");
    return clicked;
  }
  int clicked = -1;
  const float width = std::min(width_, ImGui::GetContentRegionAvail().x);  // beside the bar where the column scrolls
  const bool open = begin_combo(ui, "##cards", names_[std::size_t(chosen)], width);
  if (!open) return clicked;
  for (int k = 0; k < int(names_.size()); ++k) {
    if (ImGui::Selectable(names_[std::size_t(k)], k == chosen)) clicked = k;
    report_control(ui, names_[std::size_t(k)]);
  }
  end_combo();
  return clicked;
}

}  // namespace tyglab
