// The picture of the cloth, and the buttons over it.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

constexpr float buttons_above = 46, least_picture = 260, low_picture = 480, least_with_buttons = 110;  // px at scale 1

void set_mode(Ui& ui, int mode) {
  Preset next = ui.session.requested_preset();
  next.mode = mode;
  ui.session.propose(std::move(next));
}

/// What the panel has there belongs to no press on the cloth, and to no other mark.
void cover(Ui& ui, const char* name, const Box& box) {
  cover_viewport(ui, {box.lo.x, box.lo.y}, {box.hi.x, box.hi.y});
  ui.placing.take(name, box);
}

/// Beside the view buttons, or under them, on a ground of its own: it may stand over the cloth.
void bending_check(Ui& ui, const Region& region, const Box& buttons) {
  const char* label = "Bending springs";
  const float gap = ui.theme.px(12), pad = ui.theme.px(8), height = ui.theme.px(26);
  const float width = text_width(*ui.fonts.text, label) + ui.theme.px(24) + 2 * pad;
  const bool fits = buttons.hi.x + gap + width < region.at.x + region.size.x - ui.theme.px(16);
  const glm::vec2 at = fits ? glm::vec2(buttons.hi.x + gap, buttons.lo.y)
                            : glm::vec2(buttons.lo.x, buttons.lo.y + height + ui.theme.px(6));
  const Box box{at, at + glm::vec2(width, height)};
  ImGui::GetWindowDrawList()->AddRectFilled({box.lo.x, box.lo.y}, {box.hi.x, box.hi.y},
                                            faded(ui.theme.colors.ground, 0.85f), ui.theme.px(5));
  ImGui::SetCursorScreenPos({at.x + pad, at.y});
  if (check(ui, label, ui.scene.view.bending)) ui.scene.view.bending = !ui.scene.view.bending;
  tooltip(ui, gui::item_id(), "Also draws the bending springs, in the color of F_b.");
  cover(ui, "bending", box);
}

constexpr std::array<const char*, 5> view_numbers{"1", "2", "3", "4", "5"};

/// "1 Triangles" … or, where the viewport is narrow, the numbers alone; then the menu of colors.
struct ViewRow {
  const char* const* labels;
  float padding;         ///< at scale 1
  float buttons, width;  ///< px, without and with the menu
};

ViewRow view_row(const Ui& ui, float viewport) {
  const float room = viewport - 2 * ui.theme.px(16), gap = ui.theme.px(12), beside = gap + color_menu_width(ui);
  const auto width = [&](const auto& labels, float padding) {
    return segments_size(ui, labels.data(), int(labels.size()), padding).x;
  };
  const bool roomy = width(view_names, 11) + beside < room;
  const auto& labels = roomy ? view_names : view_numbers;
  const float padding = width(labels, 11) + beside < room ? 11.f : 4.f, buttons = width(labels, padding);
  return {labels.data(), padding, buttons,
          buttons + gap + std::clamp(room - buttons - gap, ui.theme.px(48), color_menu_width(ui))};
}

/// Height that legend and PAUSED take below the view buttons, px: there they cover no cloth that is framed.
float marks_height(const Ui& ui, float viewport, bool under_buttons) {
  const float gap = ui.theme.px(6), room = viewport - 2 * ui.theme.px(16);
  const ImVec2 legend = legend_line_size(ui.theme, room);
  const glm::vec2 paused = pause_mark_size(ui);
  const bool colored = shown_colors(ui.scene) != nullptr;
  const bool paused_in_row = !ui.presenting && view_row(ui, viewport).width + gap + paused.x <= room;
  if (ui.presenting) {
    const float name = ui.time_in_picture ? paused.y + ui.theme.px(12) : 0;  // longer than what stands beside a cloth
    return name + (colored ? legend.y + gap : 0);
  }
  float height = under_buttons ? 0 : ui.theme.px(12);
  if (colored) height += legend.y + gap;
  const bool shared = colored && legend.x + gap + paused.x <= room;
  if (!paused_in_row && !shared) height += paused.y + gap;
  return colored || !paused_in_row ? height : 0;
}

void view_buttons(Ui& ui, const Region& region) {
  const float margin = ui.theme.px(16), room = region.size.x - 2 * margin, gap = ui.theme.px(12);
  const ViewRow shown = view_row(ui, region.size.x);
  const ImVec2 lo{region.at.x + margin, region.at.y + ui.theme.px(12)};
  ImGui::SetCursorScreenPos(lo);
  const int mode = ui.session.requested_preset().mode;
  if (const int k = segments(ui, "views", shown.labels, 5, mode - 1, shown.padding); k >= 0 && k + 1 != mode)
    set_mode(ui, k + 1);
  tooltip(ui, gui::item_id(), "How the cloth is drawn", "Keys 1 to 5");
  ImVec2 hi = ImGui::GetItemRectMax();
  ImGui::SetCursorScreenPos({hi.x + gap, lo.y});
  const float menu = std::clamp(lo.x + room - hi.x - gap, ui.theme.px(48), color_menu_width(ui));
  color_menu(ui, menu);
  hi.x += gap + menu;
  cover(ui, "views", {{lo.x, lo.y}, {hi.x, hi.y}});
  if (mode == 2) bending_check(ui, region, {{lo.x, lo.y}, {hi.x, hi.y}});
}

/// A very low picture is left to the cloth: keys and menu have the views too.
bool has_buttons(const Ui& ui, const Region& region) {
  return ui.session.requested_preset().kind == Kind::cloth && !ui.presenting &&
         region.size.y >= ui.theme.px(least_with_buttons);
}

/// The cloth's picture, and those of its copies beside it.
void pictures(Ui& ui, ImDrawList& draw) {
  const glm::vec2 size = ui.viewport.size();
  for (int tile = 0; tile < ui.session.copies.tiles(); ++tile) {
    const glm::vec2 lo = ui.viewport.origin(tile), hi = lo + size;
    draw.AddImage(gui::texture(ui.scene.views.picture(ui.scene, tile)), {lo.x, lo.y}, {hi.x, hi.y}, {0, 1}, {1, 0});
    // What is left of a diverged cloth steps back, so that what is said of it is what one sees.
    if (cloth_in_tile(ui.scene, tile).divergence())
      draw.AddRectFilled({lo.x, lo.y}, {hi.x, hi.y}, faded(ui.theme.colors.ground, 0.35f));
    if (tile == 0) continue;
    if (tile % ui.viewport.columns > 0) draw.AddLine({lo.x, lo.y}, {lo.x, hi.y}, ui.theme.colors.line);
    if (tile >= ui.viewport.columns) draw.AddLine({lo.x, lo.y}, {hi.x, lo.y}, ui.theme.colors.line);
  }
}

/// What stands over the pictures. Who comes first has its place, and who comes later makes room; drawn the other way
/// round, so that no arrow runs over a number.
void marks(Ui& ui, ImDrawList& draw, const Region& region) {
  enum Layer : int { arrows, pointer, fixed, count };
  const bool bare = ui.bare();
  const float margin = ui.theme.px(16), top = region.at.y + ui.theme.px(12);
  const Box row{{region.at.x + margin, top}, {region.at.x + region.size.x - margin, top + ui.theme.px(26)}};
  // In a picture that is saved the legend stands as it was shown.
  bare ? ui.placing.back_to("legend") : ui.placing.begin(ui.theme.px(6));
  if (ui.message_box) ui.placing.take("message", *ui.message_box);
  draw.ChannelsSplit(count);
  draw.ChannelsSetCurrent(fixed);
  const bool covered = ui.banner_over_views || (ui.copy_details && ui.copy_details->over_views);
  if (!bare && has_buttons(ui, region) && !covered) view_buttons(ui, region);
  if (!bare && ui.presenting && ui.panels) scene_name(ui, draw, row);
  cloth_names(ui, draw);
  if (!bare) {
    arrow_scales(ui, draw);
    pause_mark(ui, draw, row);
    hidden_panels_mark(ui, draw);
    film_mark(ui, draw);
  }
  level_labels(ui, draw);
  color_legend(ui);
  if (!bare) {
    const glm::vec2 lo(region.at.x, region.at.y), hi = lo + glm::vec2(region.size.x, region.size.y);
    banner(ui, {lo, hi});
    copy_details(ui, {lo, {hi.x, hi.y - banner_strip(ui, hi - lo)}});
    draw.ChannelsSetCurrent(pointer);
    knife_stroke(ui, draw);
    first_cut_hint(ui, draw);
    pointer_overlay(ui, draw);
    draw.ChannelsSetCurrent(fixed);
  }
  draw.ChannelsSetCurrent(arrows);
  if (!bare)
    crossing_triangles(ui, draw), wind_overlay(ui, draw), picked_overlay(ui, draw), divergence_mark(ui, draw),
        ways_to_cloth(ui, draw);
  draw.ChannelsMerge();
}

}  // namespace

void viewport_panel(Ui& ui, const Region& whole) {
  const float timeline = timeline_height(ui, whole.size.y);
  Region region = whole;
  region.size.y -= timeline;
  const glm::vec2 size(region.size.x, region.size.y);
  const float banner = banner_strip(ui, size), details = copy_details_strip(ui, {size.x, size.y - banner}),
              foot = std::max(region.at.y + size.y - banner - details, region.at.y + 1);
  ui.viewport.box = {{region.at.x, region.at.y}, {region.at.x + region.size.x, foot}};
  // Buttons stand over a picture, but above several, whose tops they would cover, and above a low one, which they would
  // cover too much of, unless it would become too small.
  const bool buttons = has_buttons(ui, region);
  const bool low = buttons && region.size.y < ui.theme.px(low_picture) &&
                   region.size.y >= ui.theme.px(least_picture + buttons_above);
  const bool above = !ui.presenting && (ui.session.copies.tiles() > 1 || low);
  if (above) ui.viewport.box.lo.y += ui.theme.px(buttons_above);
  ui.viewport.divide(ui.session.copies.tiles());
  // Among other pictures, places have another order.
  if (std::exchange(ui.divided, {ui.viewport.columns, ui.viewport.rows}) !=
      glm::ivec2(ui.viewport.columns, ui.viewport.rows))
    ui.pause_place.reset(), ui.legend_place.reset();
  ui.viewport.buttons = above || !buttons ? 0 : ui.theme.px(buttons_above);
  if ((buttons || ui.presenting) && ui.session.copies.tiles() == 1)
    ui.viewport.buttons += marks_height(ui, ui.viewport.size().x, !above) + names_above_height(ui);
  ui.viewport.foot = names_below_height(ui);
  constexpr float usual = 0.84f, presented = 0.94f;
  ui.viewport.filled = ui.presenting ? presented : usual;
  ui.marks_from = ui.viewport.box.lo.y + ui.theme.px(above || ui.presenting ? 12 : 52);
  if (!ui.bare()) ui.viewport.covers.clear();  // what is not drawn for an image is on the screen all the same
  if (!begin_region("viewport", whole, ui.theme.colors.ground, {0, 0})) return end_region();
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  pictures(ui, draw);
  marks(ui, draw, region);
  if (timeline > 0 && !ui.bare())
    timeline_strip(
        ui, draw,
        {{region.at.x, region.at.y + region.size.y}, {region.at.x + region.size.x, whole.at.y + whole.size.y}});
  end_region();
}

}  // namespace tyglab
