// The picture of the cloth, and the buttons over it.
#include <algorithm>
#include <cmath>

#include "app/ui/frame/panels.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

constexpr float buttons_above = 46, least_picture = 260, low_picture = 480;  // pixels at scale 1

void set_mode(App& app, int mode) {
  Preset next = app.requested_preset();
  next.mode = mode;
  app.propose(std::move(next));
}

/// What the panel has there belongs to no press on the cloth, and to no other mark.
void cover(App& app, const char* name, const Box& box) {
  cover_viewport(app, {box.lo.x, box.lo.y}, {box.hi.x, box.hi.y});
  app.ui.placing.take(name, box);
}

/// Beside the view buttons, or under them, on a ground of its own: it may stand over the cloth.
void bending_check(App& app, const Region& region, const Box& buttons) {
  const char* label = "Bending springs";
  const float gap = app.theme.px(12), pad = app.theme.px(8), height = app.theme.px(26);
  const float width = text_width(*app.fonts.text, label) + app.theme.px(24) + 2 * pad;
  const bool fits = buttons.hi.x + gap + width < region.at.x + region.size.x - app.theme.px(16);
  const glm::vec2 at = fits ? glm::vec2(buttons.hi.x + gap, buttons.lo.y)
                            : glm::vec2(buttons.lo.x, buttons.lo.y + height + app.theme.px(6));
  const Box box{at, at + glm::vec2(width, height)};
  ImGui::GetWindowDrawList()->AddRectFilled({box.lo.x, box.lo.y}, {box.hi.x, box.hi.y},
                                            faded(app.theme.colors.ground, 0.85f), app.theme.px(5));
  ImGui::SetCursorScreenPos({at.x + pad, at.y});
  if (check(app, label, app.view.bending)) app.view.bending = !app.view.bending;
  tooltip(app, gui::item_id(), "Draws the bending springs too, in the colour of F_b.");
  cover(app, "bending", box);
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
  const int mode = app.requested_preset().mode;
  if (const int k = segments(app, "views", roomy ? view_names.data() : numbers, 5, mode - 1, padding);
      k >= 0 && k + 1 != mode)
    set_mode(app, k + 1);
  tooltip(app, gui::item_id(), "How the cloth is drawn (2.4)", "Keys 1 to 5");
  ImVec2 hi = ImGui::GetItemRectMax();
  ImGui::SetCursorScreenPos({hi.x + gap, lo.y});
  const float menu = std::clamp(lo.x + room - hi.x - gap, app.theme.px(48), color_menu_width(app));
  color_menu(app, menu);
  hi.x += gap + menu;
  cover(app, "views", {{lo.x, lo.y}, {hi.x, hi.y}});
  if (mode == 2) bending_check(app, region, {{lo.x, lo.y}, {hi.x, hi.y}});
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

/// What stands over the pictures. Who comes first has its place, and who comes later makes room; drawn the other way
/// round, so that no arrow runs over a number.
void marks(App& app, ImDrawList& draw, const Region& region) {
  enum Layer : int { arrows, pointer, fixed, notes, count };
  const bool bare = app.picture && !app.picture->whole_window, cloth = app.requested_preset().kind == Kind::cloth;
  const float margin = app.theme.px(16), top = region.at.y + app.theme.px(12);
  const Box row{{region.at.x + margin, top}, {region.at.x + region.size.x - margin, top + app.theme.px(26)}};
  // In a picture that is saved the legend stands as it was shown.
  bare ? app.ui.placing.back_to("legend") : app.ui.placing.begin(app.theme.px(6));
  draw.ChannelsSplit(count);
  draw.ChannelsSetCurrent(fixed);
  if (!bare && cloth) view_buttons(app, region);
  cloth_names(app, draw);
  if (!bare) {
    arrow_scales(app, draw);
    pause_mark(app, draw, row);
    draw.ChannelsSetCurrent(notes);
    message_list(app);
    draw.ChannelsSetCurrent(fixed);
    banner(app);
    draw.ChannelsSetCurrent(pointer);
    knife_stroke(app, draw);
    pointer_overlay(app, draw);
    draw.ChannelsSetCurrent(fixed);
  }
  color_legend(app);
  draw.ChannelsSetCurrent(arrows);
  if (!bare) wind_overlay(app, draw), picked_overlay(app, draw);
  draw.ChannelsMerge();
}

}  // namespace

void viewport_panel(App& app, const Region& region) {
  app.viewport.box = {{region.at.x, region.at.y}, {region.at.x + region.size.x, region.at.y + region.size.y}};
  // Buttons stand over a picture, but above several, whose tops they would cover, and above a low one, which they would
  // cover too much of, unless it would become too small.
  const bool low = app.requested_preset().kind == Kind::cloth && region.size.y < app.theme.px(low_picture) &&
                   region.size.y >= app.theme.px(least_picture + buttons_above);
  const bool above = app.copies.tiles() > 1 || low;
  if (above) app.viewport.box.lo.y += app.theme.px(buttons_above);
  app.viewport.buttons = above || app.requested_preset().kind != Kind::cloth ? 0 : app.theme.px(buttons_above);
  app.ui.notes_from = app.viewport.box.lo.y + app.theme.px(above ? 12 : 52);
  app.viewport.divide(app.copies.tiles());
  app.viewport.covers.clear();
  if (!begin_region("viewport", region, app.theme.colors.ground, {0, 0})) return end_region();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  pictures(app, draw);
  marks(app, draw, region);
  end_region();
}

}  // namespace tyglab
