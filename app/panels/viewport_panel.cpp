// The picture of the cloth, and the buttons over it.
#include <algorithm>
#include <cmath>

#include "app/panels/imgui_compat.h"
#include "app/panels/numbers.h"
#include "app/panels/panels.h"
#include "app/panels/symbol.h"
#include "app/panels/widgets.h"

namespace tyglab {
namespace {

constexpr float buttons_above = 46, least_picture = 260, low_picture = 480;  // pixels at scale 1

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
  const float gap = app.theme.px(12), beside = gap + color_menu_width(app);
  const bool roomy = width(view_names) + beside < room;
  const float padding = roomy || width(numbers) + beside < room ? 11.f : 4.f;
  const ImVec2 lo{region.at.x + margin, region.at.y + app.theme.px(12)};
  ImGui::SetCursorScreenPos(lo);
  const int mode = app.wished().mode;
  if (const int k = segments(app, "views", roomy ? view_names.data() : numbers, 5, mode - 1, padding);
      k >= 0 && k + 1 != mode)
    set_mode(app, k + 1);
  tooltip(app, gui::item_id(), "How the cloth is drawn (2.4)", "Keys 1 to 5");
  ImVec2 hi = ImGui::GetItemRectMax();
  ImGui::SetCursorScreenPos({hi.x + gap, lo.y});
  color_menu(app);
  hi.x += beside;
  cover_viewport(app, lo, hi);
  if (mode != 2) return;
  const char* label = "Bending springs";
  const float box = text_width(*app.fonts.text, label) + app.theme.px(24);
  const bool fits = hi.x + gap + box < region.at.x + region.size.x - margin;
  const ImVec2 at = fits ? ImVec2(hi.x + gap, lo.y) : ImVec2(lo.x, hi.y + app.theme.px(6));
  ImGui::SetCursorScreenPos(at);
  if (check(app, label, app.view.bending)) app.view.bending = !app.view.bending;
  tooltip(app, gui::item_id(), "Draws the bending springs too, in the colour of F_b.");
  cover_viewport(app, at, ImGui::GetItemRectMax());
}

/// Under each picture, or overlaid one above the other: which cloth it is, and whether it has diverged.
void cloth_names(App& app, ImDrawList& draw) {
  const Copies& copies = app.copies;
  if (copies.lockstep.empty()) return;
  const Tokens& c = app.theme.colors;
  const ImFont& font = *app.fonts.text;
  const float pad = app.theme.px(8), sample = app.theme.px(24), height = font.FontSize + pad;
  const glm::vec2 size = app.viewport.size();
  for (int n = Copies::original; n < int(copies.lockstep.size()); ++n) {
    const auto& divergence = cloth_of(app, n).divergence();
    std::string name = name_of_cloth(app, n);
    if (n == copies.reference) name += " · reference";
    if (divergence) name += " · diverged at t = " + time_number(divergence->t, cloth_of(app, n).preset().dt) + " s";
    name = fitted(font, name, size.x - sample - 5 * pad);
    const float line = copies.overlaid ? height * float(int(copies.lockstep.size()) - 1 - n) : 0;
    const glm::vec2 at = app.viewport.origin(copies.overlaid ? 0 : n + 1) + glm::vec2(2 * pad, size.y - 2 * pad);
    const ImVec2 lo{std::round(at.x), std::round(at.y - line - height)};
    const float middle = std::round(lo.y + height / 2);
    draw.AddRectFilled(lo, {lo.x + sample + 3 * pad + text_width(font, name), lo.y + height}, faded(c.ground, 0.75f),
                       app.theme.px(6));
    const ImVec2 ends[2] = {{lo.x + pad, middle}, {lo.x + pad + sample, middle}};
    CurveStyle style = style_of_cloth(app, n);
    if (copies.overlaid) style.line = LineStyle::solid;  // as the nets are drawn
    draw_styled_line(draw, ends, 2, style, app.theme.scale);
    draw_text(draw, font, {lo.x + 2 * pad + sample, std::round(middle - font.FontSize / 2)},
              divergence ? c.danger : c.text, name);
  }
}

/// The cloth's picture, and those of its copies beside it.
void pictures(App& app, ImDrawList& draw) {
  const glm::vec2 size = app.viewport.size();
  for (int tile = 0; tile < app.copies.tiles(); ++tile) {
    const glm::vec2 lo = app.viewport.origin(tile), hi = lo + size;
    draw.AddImage(gui::texture(app.views.picture(app, tile)), {lo.x, lo.y}, {hi.x, hi.y}, {0, 1}, {1, 0});
    // What is left of a diverged cloth steps back, so that what is said of it is what one sees.
    if (cloth_in_tile(app, tile).divergence())
      draw.AddRectFilled({lo.x, lo.y}, {hi.x, hi.y}, faded(app.theme.colors.ground, 0.35f));
    if (tile == 0) continue;
    if (tile % app.viewport.columns > 0) draw.AddLine({lo.x, lo.y}, {lo.x, hi.y}, app.theme.colors.line);
    if (tile >= app.viewport.columns) draw.AddLine({lo.x, lo.y}, {hi.x, lo.y}, app.theme.colors.line);
  }
}

}  // namespace

void viewport_panel(App& app, const Region& region) {
  app.viewport.box = {{region.at.x, region.at.y}, {region.at.x + region.size.x, region.at.y + region.size.y}};
  // Buttons stand over a picture, but above several, whose tops they would cover, and above a low one, which they would
  // cover too much of, unless it would become too small.
  const bool low = app.wished().kind == Kind::cloth && region.size.y < app.theme.px(low_picture) &&
                   region.size.y >= app.theme.px(least_picture + buttons_above);
  const bool above = app.copies.tiles() > 1 || low;
  if (above) app.viewport.box.lo.y += app.theme.px(buttons_above);
  app.viewport.buttons = above || app.wished().kind != Kind::cloth ? 0 : app.theme.px(buttons_above);
  app.ui.notes_from = app.viewport.box.lo.y + app.theme.px(above ? 12 : 52);
  app.viewport.divide(app.copies.tiles());
  app.viewport.covers.clear();
  if (!begin_region("viewport", region, app.theme.colors.ground, {0, 0})) return end_region();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  pictures(app, draw);
  const bool bare = app.picture && !app.picture->whole_window;
  if (!bare) viewport_overlay(app);
  cloth_names(app, draw);
  color_legend(app);
  if (bare) return end_region();
  if (app.wished().kind == Kind::cloth) view_buttons(app, region);
  message_list(app);
  banner(app);
  end_region();
}

}  // namespace tyglab
