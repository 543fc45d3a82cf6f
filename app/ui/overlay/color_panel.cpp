// The coloring of the cloth: the list of quantities, and the legend in the viewport's corner.
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "app/base/text.h"
#include "app/ui/kit/color_legend.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

void choice(Ui& ui, std::optional<ParticleField> field, const char* title, const char* help) {
  const auto& chosen = ui.scene.colors.chosen;
  const std::string why = field ? why_not_colored(ui.scene, *field) : "";
  const bool now = field == (chosen ? std::optional(chosen->field) : std::nullopt);
  if (ImGui::Selectable(title, now, why.empty() ? 0 : ImGuiSelectableFlags_Disabled))
    ui.act([field](Ui& u) { u.color_by(field); });
  report_control(ui, std::string("colour.") + (field ? std::string(info(*field).name) : "none"));
  tooltip(ui, gui::item_id(), why.empty() ? help : why.c_str());
}

/// A drag of the colors moves the end of the scale, which then stays; a double click lets it follow the values again.
void scale_grip(Ui& ui, FieldColors& colors, const LegendParts& parts) {
  const float over = ui.theme.px(6), length = std::max(parts.bar_hi.x - parts.bar_lo.x, 1.f);
  ImGui::SetCursorScreenPos({parts.bar_lo.x, parts.bar_lo.y - over});
  gui::press_area("color scale", {length + over, parts.bar_hi.y - parts.bar_lo.y + 2 * over});
  report_control(ui, "color_scale");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  const bool root = root_scale(colors.field);
  tooltip(
      ui, gui::item_id(),
      std::string("Drag to move the end of the scale: the length of the colors is a factor of 10. Double-click for "
                  "an automatic scale.") +
          (root ? " The colors follow the square root of the tension, so that more than the corners is visible." : ""));
  if (ImGui::IsItemActive() && ui.input.double_click) {
    colors.fixed.reset();
  } else if (const float moved = ImGui::GetIO().MouseDelta.x; ImGui::IsItemActive() && moved != 0) {
    constexpr double least = 1e-12, most = 1e12;
    colors.fixed = std::clamp(colors.top() * std::pow(10, moved / length), least, most);
  } else if (ImGui::IsItemDeactivated() && colors.fixed) {
    colors.fixed = rounded(*colors.fixed, 2);
  }
}

/// The number at the end of the scale, which can be typed: the scale then stays until 0 is typed.
void top_cell(Ui& ui, FieldColors& colors, ImVec2 right_end) {
  const FieldInfo& field = info(colors.field);
  const float width = ui.theme.px(70), height = ui.theme.px(18);
  ImGui::SetCursorScreenPos({right_end.x + ui.theme.px(4) - width, std::round(right_end.y - height / 2)});
  const SliderResult typed = value_cell(ui, "colour top", colors.top(), short_number(rounded(colors.top(), 3)), width,
                                        height, "the end of the scale", field.unit);
  report_control(ui, "colour_top");
  tooltip(ui, gui::item_id(),
          colors.fixed ? "The scale ends at this value. Double-click the colors for an automatic scale."
                       : "The scale follows the largest value. Double-click to type its end, or drag the colors.");
  if (!typed.changed) return;
  colors.fixed.reset();
  if (typed.value > 0) colors.fixed = typed.value;
}

/// Where the legend can stand, the best first: where the viewport has room for one more picture, or in a corner; whole,
/// or else on a single line, or on a short one.
std::array<std::optional<Box>, 15> legend_places(const Ui& ui) {
  const Viewport& viewport = ui.viewport;
  const float margin = ui.theme.px(16);
  const auto in = [&](glm::vec2 lo, auto size_in, ScreenCorner corner) {
    const Box area{lo + margin, viewport.box.hi - margin};
    const ImVec2 size = size_in(ui.theme, area.hi.x - area.lo.x);
    return ui.placing.in_corner(area, {size.x, size.y}, corner);
  };
  const auto free = viewport.free_place(ui.session.copies.tiles());
  const glm::vec2 lo = viewport.box.lo;
  return {free ? in(*free, legend_size, ScreenCorner::lower_right) : std::nullopt,
          free ? in(*free, legend_line_size, ScreenCorner::lower_right) : std::nullopt,
          free ? in(*free, legend_short_line_size, ScreenCorner::lower_right) : std::nullopt,
          in(lo, legend_size, ScreenCorner::lower_right),
          in(lo, legend_size, ScreenCorner::lower_left),
          in(lo, legend_size, ScreenCorner::upper_right),
          in(lo, legend_size, ScreenCorner::upper_left),
          in(lo, legend_line_size, ScreenCorner::lower_right),
          in(lo, legend_line_size, ScreenCorner::lower_left),
          in(lo, legend_line_size, ScreenCorner::upper_right),
          in(lo, legend_line_size, ScreenCorner::upper_left),
          in(lo, legend_short_line_size, ScreenCorner::lower_right),
          in(lo, legend_short_line_size, ScreenCorner::lower_left),
          in(lo, legend_short_line_size, ScreenCorner::upper_right),
          in(lo, legend_short_line_size, ScreenCorner::upper_left)};
}

/// While the cloth swings the legend stays, whatever comes under it for a moment; it leaves a cloth that stays there.
void place_legend(Ui& ui, std::span<const std::optional<Box>> places) {
  constexpr float much = 0.25f;     // of the legend
  constexpr double patience = 0.7;  // s
  const std::vector<Box> parts = drawn_parts(ui);
  const bool stands = ui.legend_place && places[*ui.legend_place];
  const auto crowded = [&](const Box& box) {
    return covered(box, parts) > much * (box.hi.x - box.lo.x) * (box.hi.y - box.lo.y);
  };
  if (!stands || !crowded(*places[*ui.legend_place])) ui.legend_clear = ui.now;
  if (stands && ui.session.pacing.playing && ui.now - ui.legend_clear < patience) return;
  const auto before = std::exchange(ui.legend_place, choose_place(places, parts, ui.legend_place));
  if (ui.legend_place != before) ui.legend_clear = ui.now;
}

}  // namespace

float color_menu_width(const Ui& ui) {
  return ui.theme.px(124);
}

void color_menu(Ui& ui, float width) {
  const FieldColors* shown = shown_colors(ui.scene);
  const std::string title = shown != nullptr ? std::string(info(shown->field).title) : "Texture";
  if (begin_combo(ui, "##colour", fitted(*ui.fonts.text, title, width - ui.theme.px(34)).c_str(), width)) {
    choice(ui, std::nullopt, "Texture", "The cloth's texture, lit.");
    for (const FieldInfo& field : particle_fields())
      choice(ui, field.field, std::string(field.title).c_str(), std::string(field.help).c_str());
    end_combo();
  } else {
    tooltip(ui, gui::item_id(), "The quantity that colors the cloth", ui.keys_of("next_color"));
  }
}

void color_legend(Ui& ui) {
  const FieldColors* shown = shown_colors(ui.scene);
  if (shown == nullptr) return;
  const auto places = legend_places(ui);
  place_legend(ui, places);
  if (!ui.legend_place) return;
  const Box& box = *places[*ui.legend_place];
  const ImVec2 at{box.lo.x, box.lo.y}, size{box.hi.x - box.lo.x, box.hi.y - box.lo.y};
  const PlotPaint paint{*ImGui::GetWindowDrawList(), ui.theme, ui.fonts};
  const ColorLegend legend{.field = info(shown->field),
                           .map = shown->map(light_ground(ui.scene)),
                           .top = shown->top(),
                           .root = root_scale(shown->field),
                           .marked = ui.scene.colors.under_pointer,
                           .beyond = shown->beyond(),
                           .grip = true};
  const LegendParts parts = draw_color_legend(paint, at, size, legend);
  scale_grip(ui, *ui.scene.colors.chosen, parts);
  top_cell(ui, *ui.scene.colors.chosen, parts.number);
  ui.placing.take("legend", box);
  cover_viewport(ui, {box.lo.x, box.lo.y}, {box.hi.x, box.hi.y});
}

}  // namespace tyglab
