// The building blocks of all marks over the cloth.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/base/text.h"
#include "app/render/solid_mesh.h"
#include "app/session/motion.h"
#include "app/tools/tools.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "core/model/words.h"

namespace tyglab {

std::optional<ImVec2> on_screen(const Ui& ui, int tile, glm::dvec3 world) {
  const auto pixel = ui.scene.camera.project(world, ui.viewport.size());
  if (!pixel || !std::isfinite(pixel->x) || !std::isfinite(pixel->y) || std::abs(pixel->x) > 1e5f ||
      std::abs(pixel->y) > 1e5f)
    return std::nullopt;
  return vec(*pixel + ui.viewport.origin(tile));
}

std::optional<ImVec2> particle_on_screen(Ui& ui, int tile, Pins::Site site) {
  const Simulation& cloth = cloth_in_tile(ui.scene, tile);  // which may have parted elsewhere
  return cloth.has(site.i, site.j) ? on_screen(ui, tile, cloth.position(site.i, site.j)) : std::nullopt;
}

namespace {

Box box_round(ImVec2 a, ImVec2 b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

/// The box of what of these places is seen.
void add_box(const Ui& ui, int tile, std::initializer_list<glm::dvec3> places, std::vector<Box>& to) {
  std::optional<Box> all;
  for (const glm::dvec3& place : places)
    if (const auto at = on_screen(ui, tile, place)) {
      const Box box = all ? *all : box_round(*at, *at);
      all = Box{{std::min(box.lo.x, at->x), std::min(box.lo.y, at->y)},
                {std::max(box.hi.x, at->x), std::max(box.hi.y, at->y)}};
    }
  if (all) to.push_back({all->lo - 1.f, all->hi + 1.f});
}

void add_weight(const Ui& ui, const Simulation& cloth, int tile, std::vector<Box>& to) {
  const WeightModel model = weight_model(cloth.preset(), cloth.positions().at(0, 0));
  const glm::dvec3 weight(model.weight), side(1.2 * model.radius, 0, 0), down(0, 1.2 * model.radius, 0);
  const double unit = model.radius / 0.19;
  const glm::dvec3 rest(weight.x, cloth.preset().x_0.y, weight.z), top = rest + glm::dvec3(0, 3.1 * unit, 0);
  add_box(ui, tile, {top - side, top + side, weight - down - side, weight - down + side}, to);
  const glm::dvec3 ceiling(0.5 * unit, 0, 0), thick(0, 0.1 * unit, 0), line(unit, 0, 0);
  add_box(ui, tile, {top - ceiling - thick, top + ceiling}, to);
  add_box(ui, tile, {rest - line, rest + line}, to);
}

/// Patches of the lattice, at most that many along each side.
void add_patches(const Ui& ui, const Simulation& cloth, int tile, std::vector<Box>& to) {
  constexpr int most = 12;
  const PositionView x = cloth.positions();
  const int down = std::max(1, std::min(x.rows - 1, most)), across = std::max(1, std::min(x.columns - 1, most));
  const auto place = [&](int k, int l) { return x.at(k * (x.rows - 1) / down, l * (x.columns - 1) / across); };
  for (int k = 0; k < down; ++k)
    for (int l = 0; l < across; ++l)
      add_box(ui, tile, {place(k, l), place(k + 1, l), place(k, l + 1), place(k + 1, l + 1)}, to);
}

}  // namespace

std::vector<Box> drawn_parts(Ui& ui) {
  std::vector<Box> parts;
  for (int tile = 0; tile < ui.session.copies.tiles(); ++tile) {
    const Simulation& cloth = cloth_in_tile(ui.scene, tile);
    cloth.preset().kind == Kind::one_weight ? add_weight(ui, cloth, tile, parts) : add_patches(ui, cloth, tile, parts);
  }
  if (wind_arrow_shown(ui.tools)) {
    const WindArrow arrow = wind_arrow(ui.tools, requested_wind(ui.tools));
    add_box(ui, 0, {arrow.base, arrow.tip}, parts);
  }
  return parts;
}

namespace {

/// Beside a level line that reaches as far as `reach` to both sides of `middle`, m.
void level_label(Ui& ui, ImDrawList& draw, glm::dvec3 middle, double reach, const std::string& words) {
  const ImFont& font = *ui.fonts.text;
  const float pad = ui.theme.px(6), gap = ui.theme.px(8), height = font.FontSize + pad,
              width = std::ceil(text_width(font, words)) + 2 * pad;
  const glm::dvec3 side(reach, 0, 0);
  const Box picture{ui.viewport.origin(0), ui.viewport.origin(0) + ui.viewport.size()};
  std::vector<Box> places;
  const auto add = [&](std::optional<ImVec2> end, float to_left) {
    if (!end) return;
    const glm::vec2 lo = glm::round(glm::vec2(end->x + to_left, end->y - height / 2));
    if (picture.contains(lo) && picture.contains(lo + glm::vec2(width, height)))
      places.push_back({lo, lo + glm::vec2(width, height)});
  };
  add(on_screen(ui, 0, middle + side), gap), add(on_screen(ui, 0, middle - side), -gap - width);
  // In a picture that is saved it stands as it was shown.
  const std::string name = "level " + words;
  const Box* const before = ui.bare() ? ui.placing.find(name) : nullptr;
  const std::optional<Box> box = before != nullptr ? *before : ui.placing.first_free(places);
  if (!box) return;
  ui.placing.take(name, *box);
  draw.AddRectFilled(vec(box->lo), vec(box->hi), faded(ui.theme.colors.ground, 0.85f), ui.theme.px(4));
  draw_on_baseline(draw, font, {box->lo.x + pad, baseline_at(ui.fonts, (box->lo.y + box->hi.y) / 2)},
                   ui.theme.colors.text, words);
}

}  // namespace

void level_labels(Ui& ui, ImDrawList& draw) {
  const Simulation& cloth = cloth_in_tile(ui.scene, 0);
  const Preset& preset = cloth.preset();
  if (preset.kind != Kind::one_weight) return;
  const double reach = weight_model(preset, cloth.positions().at(0, 0)).radius / 0.19;
  level_label(ui, draw, preset.x_0, reach, "x₀: y = " + quantity(preset.x_0.y, "m", 3));
  const double sag = preset.k > 0 ? preset.m * preset.g / preset.k : 0;
  if (ui.scene.view.equilibrium && sag != 0)
    level_label(ui, draw, preset.x_0 - glm::dvec3(0, sag, 0), reach, "equilibrium");
}

void danger_ground(Ui& ui, const Box& box, const char* mark) {
  const ImVec2 lo = vec(box.lo), hi = vec(box.hi);
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(lo, hi, ui.theme.colors.panel, ui.theme.px(8));
  draw.AddRect(lo, hi, ui.theme.colors.danger, ui.theme.px(8), 0, std::max(1.f, ui.theme.px(1.5f)));
  cover_viewport(ui, lo, hi);
  ui.placing.take(mark, box);
}

void ring(Ui& ui, ImDrawList& draw, ImVec2 at, float radius, ImU32 color, float width) {
  // A dark rim keeps it visible on a light cloth.
  draw.AddCircle(at, ui.theme.px(radius), faded(ui.theme.colors.ground, 0.6f), 32, ui.theme.scale * (width + 2));
  draw.AddCircle(at, ui.theme.px(radius), color, 32, ui.theme.scale * width);
}

bool draw_arrow(Ui& ui, ImDrawList& draw, ImVec2 from, ImVec2 to, const CurveStyle& style, bool cut_short) {
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (length < ui.theme.px(10)) return false;
  // Twice as thick for an audience, as far as the arrow is long enough for its head.
  const float weight = ui.presenting ? std::min(2.f, length / ui.theme.px(12)) : 1;
  const float ux = dx / length, uy = dy / length, head = ui.theme.px(9 * weight);
  const ImVec2 neck{to.x - ux * head, to.y - uy * head};
  draw.AddLine(from, neck, faded(ui.theme.colors.ground, 0.55f), ui.theme.px(2.6f * weight + 2.4f));
  const ImVec2 line[2] = {from, neck};
  CurveStyle thick = style;
  thick.width = 2.6f * weight;
  draw_styled_line(draw, line, 2, thick, ui.theme.scale);
  const ImVec2 left{neck.x - uy * head * 0.5f, neck.y + ux * head * 0.5f},
      right{neck.x + uy * head * 0.5f, neck.y - ux * head * 0.5f};
  if (cut_short)
    draw.AddTriangle(to, left, right, style.color, std::max(1.f, ui.theme.px(1.5f * weight)));
  else
    draw.AddTriangleFilled(to, left, right, style.color);
  return true;
}

bool keep_in_picture(const Ui& ui, int tile, ImVec2 from, ImVec2& to) {
  const float margin = ui.theme.px(6);
  const glm::vec2 lo = ui.viewport.origin(tile) + margin, hi = lo + ui.viewport.size() - 2 * margin;
  float part = 1;
  const auto keep = [&](float begin, float end, float least, float most) {
    if (end > most) part = std::min(part, std::max((most - begin) / (end - begin), 0.f));
    if (end < least) part = std::min(part, std::max((least - begin) / (end - begin), 0.f));
  };
  keep(from.x, to.x, lo.x, hi.x), keep(from.y, to.y, lo.y, hi.y);
  to = {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
  return part < 1;
}

// The name of the scene in presentation mode.

void scene_name(Ui& ui, ImDrawList& draw, const Box& row) {
  const Tokens& c = ui.theme.colors;
  const ImFont &font = *ui.fonts.title, &mono = *ui.fonts.mono;
  const float pad = ui.theme.px(12), gap = ui.theme.px(14);
  const Preset& preset = ui.session.preset();
  const std::string time =
      ui.time_in_picture ? "t = " + time_number(clock_time(ui.session), preset.dt) + " s" : std::string();
  const float time_width = time.empty() ? 0 : gap + text_width(mono, time);
  // PAUSED has its place beside it.
  const float most = row.hi.x - row.lo.x - pause_mark_size(ui).x - gap;
  const std::string name = fitted(font, preset.name, most - 2 * pad - time_width);
  const float name_width = text_width(font, name);
  const Box box{row.lo, {std::ceil(row.lo.x + 2 * pad + name_width + time_width), row.hi.y}};
  draw.AddRectFilled(vec(box.lo), vec(box.hi), faded(c.ground, 0.85f), ui.theme.px(6));
  const float baseline = baseline_at(ui.fonts, (box.lo.y + box.hi.y) / 2);
  draw_on_baseline(draw, font, {box.lo.x + pad, baseline}, c.text, name);
  if (!time.empty()) draw_on_baseline(draw, mono, {box.lo.x + pad + name_width + gap, baseline}, c.text, time);
  ui.placing.take("scene_name", box);
}

}  // namespace tyglab
