// The picture of the cloth, and the buttons over it.
#include <algorithm>
#include <cmath>

#include "app/panels/imgui_compat.h"
#include "app/panels/panels.h"
#include "app/panels/symbol.h"
#include "app/panels/widgets.h"

namespace tyglab {
namespace {

void set_mode(App& app, int mode) {
  Preset next = app.wished();
  next.mode = mode;
  app.propose(std::move(next));
}

/// "1 Triangles" … or, where the viewport is narrow, the numbers alone.
void view_buttons(App& app, const Region& region) {
  static constexpr const char* numbers[] = {"1", "2", "3", "4", "5"};
  const float margin = app.theme.px(16), room = region.size.x - 2 * margin;
  const auto width = [&](const auto& labels) {
    float sum = 0;
    for (const char* label : labels) sum += text_width(*app.fonts.text, label) + 2 * app.theme.px(11) + 1;
    return sum;
  };
  const bool roomy = width(view_names) < room;
  const float padding = roomy || width(numbers) < room ? 11.f : 4.f;
  const ImVec2 lo{region.at.x + margin, region.at.y + app.theme.px(12)};
  ImGui::SetCursorScreenPos(lo);
  const int mode = app.wished().mode;
  if (const int k = segments(app, "views", roomy ? view_names.data() : numbers, 5, mode - 1, padding);
      k >= 0 && k + 1 != mode)
    set_mode(app, k + 1);
  tooltip(app, gui::item_id(), "How the cloth is drawn (2.4)", "Keys 1 to 5");
  const ImVec2 hi = ImGui::GetItemRectMax();
  cover_viewport(app, lo, hi);
  if (mode != 2) return;
  const char* label = "Bending springs";
  const float box = text_width(*app.fonts.text, label) + app.theme.px(24), gap = app.theme.px(16);
  const bool beside = hi.x + gap + box < region.at.x + region.size.x - margin;
  const ImVec2 at = beside ? ImVec2(hi.x + gap, lo.y) : ImVec2(lo.x, hi.y + app.theme.px(6));
  ImGui::SetCursorScreenPos(at);
  if (check(app, label, app.view.bending)) app.view.bending = !app.view.bending;
  tooltip(app, gui::item_id(), "Draws the bending springs too, in the colour of F_b.");
  cover_viewport(app, at, ImGui::GetItemRectMax());
}

}  // namespace

void viewport_panel(App& app, const Region& region) {
  app.viewport.box = {{region.at.x, region.at.y}, {region.at.x + region.size.x, region.at.y + region.size.y}};
  app.viewport.covers.clear();
  if (!begin_region("viewport", region, app.theme.colors.ground, {0, 0})) return end_region();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  const ImVec2 hi{region.at.x + region.size.x, region.at.y + region.size.y};
  draw.AddImage(gui::texture(app.renderer->texture_id()), region.at, hi, {0, 1}, {1, 0});
  // What is left of a diverged cloth steps back, so that the banner is what one sees.
  if (app.simulation->divergence()) draw.AddRectFilled(region.at, hi, faded(app.theme.colors.ground, 0.35f));
  viewport_overlay(app);
  if (app.wished().kind == Kind::cloth) view_buttons(app, region);
  message_list(app);
  banner(app);
  end_region();
}

}  // namespace tyglab
