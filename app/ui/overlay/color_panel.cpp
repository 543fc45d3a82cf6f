// What colours the cloth: the list to choose from, and the legend in the viewport's corner.
#include <algorithm>
#include <array>
#include <vector>

#include "app/base/numbers.h"
#include "app/ui/frame/commands.h"
#include "app/ui/frame/panels.h"
#include "app/ui/kit/color_legend.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/slider.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

void choice(App& app, std::optional<ParticleField> field, const char* title, const char* help) {
  const auto& chosen = app.colors.chosen;
  const std::string why = field ? why_not_colored(app, *field) : "";
  const bool now = field == (chosen ? std::optional(chosen->field) : std::nullopt);
  if (ImGui::Selectable(title, now, why.empty() ? 0 : ImGuiSelectableFlags_Disabled))
    app.request(request::ColorBy{field});
  report_control(app, std::string("colour.") + (field ? std::string(info(*field).name) : "none"));
  tooltip(app, gui::item_id(), why.empty() ? help : why.c_str());
}

/// The number at the end of the scale, which can be typed: the scale is then fixed until nothing is typed.
void top_cell(App& app, FieldColors& colors, ImVec2 right_end) {
  const FieldInfo& field = info(colors.field);
  const float width = app.theme.px(70), height = app.theme.px(18);
  ImGui::SetCursorScreenPos({right_end.x + app.theme.px(4) - width, std::round(right_end.y - height / 2)});
  const SliderResult typed =
      value_cell(app, "colour top", colors.top(), short_number(rounded(colors.top(), 4)), width, height, field.unit);
  report_control(app, "colour_top");
  tooltip(app, gui::item_id(),
          colors.fixed ? "The scale ends here, as it was typed. Double-click and type 0 for an automatic scale."
                       : "The scale follows the greatest value. Double-click to type where it is to end.");
  if (!typed.changed) return;
  colors.fixed.reset();
  if (typed.value > 0) colors.fixed = typed.value;
}

/// Where the legend can stand, the best first: where the viewport has room for one more picture, or in a corner; whole,
/// or else on a single line.
std::array<std::optional<Box>, 10> legend_places(const App& app) {
  const Viewport& viewport = app.viewport;
  const float margin = app.theme.px(16);
  const auto in = [&](glm::vec2 lo, auto size_in, ScreenCorner corner) {
    const Box area{lo + margin, viewport.box.hi - margin};
    const ImVec2 size = size_in(app.theme, area.hi.x - area.lo.x);
    return app.ui.placing.in_corner(area, {size.x, size.y}, corner);
  };
  const auto free = viewport.free_place(app.copies.tiles());
  const glm::vec2 lo = viewport.box.lo;
  return {free ? in(*free, legend_size, ScreenCorner::lower_right) : std::nullopt,
          free ? in(*free, legend_line_size, ScreenCorner::lower_right) : std::nullopt,
          in(lo, legend_size, ScreenCorner::lower_right),
          in(lo, legend_size, ScreenCorner::lower_left),
          in(lo, legend_size, ScreenCorner::upper_right),
          in(lo, legend_size, ScreenCorner::upper_left),
          in(lo, legend_line_size, ScreenCorner::lower_right),
          in(lo, legend_line_size, ScreenCorner::lower_left),
          in(lo, legend_line_size, ScreenCorner::upper_right),
          in(lo, legend_line_size, ScreenCorner::upper_left)};
}

}  // namespace

float color_menu_width(const App& app) {
  return app.theme.px(124);
}

void color_menu(App& app, float width) {
  const FieldColors* shown = shown_colors(app);
  const std::string title = shown != nullptr ? std::string(info(shown->field).title) : "Own colours";
  if (begin_combo(app, "##colour", fitted(*app.fonts.text, title, width - app.theme.px(34)).c_str(), width)) {
    choice(app, std::nullopt, "Own colours", "The cloth's texture in the scene's light.");
    for (const FieldInfo& field : particle_fields())
      choice(app, field.field, std::string(field.title).c_str(), std::string(field.help).c_str());
    end_combo();
  } else {
    tooltip(app, gui::item_id(), "What colours the cloth", row_of(Command::next_color).keys);
  }
}

void color_legend(App& app) {
  const FieldColors* shown = shown_colors(app);
  if (shown == nullptr) return;
  const auto places = legend_places(app);
  // While the cloth swings the legend stays, whatever comes under it.
  const bool still = !app.pacing.playing || !app.ui.legend_place;
  app.ui.legend_place = choose_place(places, still ? drawn_parts(app) : std::vector<Box>(), app.ui.legend_place);
  if (!app.ui.legend_place) return;
  const Box& box = *places[*app.ui.legend_place];
  const ImVec2 at{box.lo.x, box.lo.y}, size{box.hi.x - box.lo.x, box.hi.y - box.lo.y};
  const PlotPaint paint{*ImGui::GetWindowDrawList(), app.theme, app.fonts};
  const ColorLegend legend{info(shown->field), shown->map(light_ground(app)),
                           shown->top(),       app.colors.under_pointer,
                           shown->beyond(),    false};
  top_cell(app, *app.colors.chosen, draw_color_legend(paint, at, size, legend));
  app.ui.placing.take("legend", box);
  cover_viewport(app, {box.lo.x, box.lo.y}, {box.hi.x, box.hi.y});
}

}  // namespace tyglab
