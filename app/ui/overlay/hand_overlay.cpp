// The tools of the hand over the cloth: the arrow of the wind, the stroke of the knife and its cut.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "app/base/text.h"
#include "app/tools/tools.h"
#include "app/ui/kit/widgets.h"
#include "app/ui/overlay/overlay.h"
#include "core/forces/contact.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

constexpr double stroke_seen = 0.7;  // s

/// Where a label of that size can stand: under the foot of the arrow, over it, or beside it.
std::optional<Box> place_of_label(const Ui& ui, glm::vec2 foot, glm::vec2 size) {
  const float away = ui.theme.px(22), margin = ui.theme.px(8);
  const glm::vec2 lo = ui.viewport.origin(0) + margin, hi = ui.viewport.origin(0) + ui.viewport.size() - margin;
  std::vector<Box> places;
  for (const glm::vec2 at : {foot + glm::vec2(-size.x / 2, away), foot + glm::vec2(-size.x / 2, -away - size.y),
                             foot + glm::vec2(away, -size.y / 2), foot + glm::vec2(-away - size.x, -size.y / 2),
                             foot + glm::vec2(-size.x / 2, -2 * away - 2 * size.y)}) {
    const glm::vec2 inside = glm::round(glm::max(lo, glm::min(at, hi - size)));
    places.push_back({inside, inside + size});
  }
  return ui.placing.first_free(places);
}

/// The present wind, with gusts.
glm::dvec3 blowing(const Ui& ui) {
  const Simulation& simulation = *ui.session.simulation;
  return in_gusts(simulation.preset(), simulation.time()).*wind_of_arrow(ui.tools);
}

/// "W  4.02 mN" or "u  3.5 m/s", and in gusts what blows now.
void wind_label(Ui& ui, ImDrawList& draw, glm::vec2 foot, const glm::dvec3& wind) {
  const Tokens& c = ui.theme.colors;
  const ImFont &mono = *ui.fonts.mono, &small = *ui.fonts.small;
  const float pad = ui.theme.px(8), gap = ui.theme.px(8), line = ui.theme.px(20);
  const char* const name = wind_of_arrow(ui.tools) == &Preset::W ? "W" : "u";
  const ScaledUnit unit = scaled_unit(glm::length(wind), *name == 'W' ? "N" : "m/s");
  const std::string strength = short_number(glm::length(wind) / unit.size, 3) + " " + unit.name;
  const bool gusty = gusts(ui.session.preset());
  const std::string now = "now " + steady_number(glm::length(blowing(ui)) / unit.size) + " " + unit.name;
  const float symbol = symbol_width(ui.fonts, name);
  const float width = std::max(symbol + gap + text_width(mono, strength), gusty ? text_width(small, now) : 0.f);
  const glm::vec2 size = glm::ceil(glm::vec2(width + 2 * pad, line * (gusty ? 2.f : 1.f) + pad / 2));
  const auto box = place_of_label(ui, foot, size);
  if (!box) return;
  ui.placing.take("wind", *box);
  draw.AddRectFilled(vec(box->lo), vec(box->hi), faded(c.ground, 0.85f), ui.theme.px(6));
  const float x = box->lo.x + pad, baseline = baseline_at(ui.fonts, box->lo.y + line / 2 + pad / 4);
  draw_symbol(draw, ui.fonts, {x, baseline}, name, c.text);
  draw_on_baseline(draw, mono, {x + symbol + gap, baseline}, c.text, strength);
  if (gusty) draw_on_baseline(draw, small, {x, baseline + line}, c.quiet, now);
}

void stroke_part(Ui& ui, ImDrawList& draw, const Tool::StrokePoint& a, const Tool::StrokePoint& b) {
  const float left = float(1 - (ui.now - b.time) / stroke_seen);
  const glm::vec2 origin = ui.viewport.origin(b.tile);
  draw.AddLine(vec(origin + a.at), vec(origin + b.at), faded(ui.theme.colors.ground, 0.5f * left), ui.theme.px(5));
  draw.AddLine(vec(origin + a.at), vec(origin + b.at), faded(ui.theme.colors.magenta, left), ui.theme.px(2.5f));
}

}  // namespace

void wind_overlay(Ui& ui, ImDrawList& draw) {
  if (!wind_arrow_shown(ui.tools)) return;
  const Tokens& c = ui.theme.colors;
  const glm::dvec3 wind = requested_wind(ui.tools);
  const WindArrow arrow = wind_arrow(ui.tools, wind);
  const auto base = on_screen(ui, 0, arrow.base), tip = on_screen(ui, 0, arrow.tip);
  if (!base || !tip) return;
  const bool taken = ui.tools.tool.kind == Tool::Kind::wind, near = wind_under_pointer(ui.tools);
  if (gusts(ui.session.preset())) {
    const auto now = on_screen(ui, 0, wind_arrow(ui.tools, blowing(ui)).tip);
    if (now) draw_arrow(ui, draw, *base, *now, {faded(c.sky, 0.5f), LineStyle::solid, 2});
  }
  const bool shortened = glm::length(arrow.tip - arrow.base) < 0.999 * glm::length(wind) * arrow.metres_per_unit;
  draw_arrow(ui, draw, *base, *tip, {c.sky, LineStyle::solid, 2}, shortened);
  draw.AddCircleFilled(*base, ui.theme.px(3), c.sky, 16);
  ring(ui, draw, *tip, 8, taken || near ? c.accent : faded(c.sky, 0.7f), taken || near ? 2.5f : 1.5f);
  wind_label(ui, draw, {base->x, base->y}, wind);
}

void knife_stroke(Ui& ui, ImDrawList& draw) {
  auto& stroke = ui.tools.tool.stroke;
  if (!ui.settings.handling.cut_along_path) stroke.clear();
  std::erase_if(stroke, [&](const Tool::StrokePoint& point) {
    return ui.now - point.time > stroke_seen || point.tile >= ui.session.copies.tiles();
  });
  if (stroke.empty()) return;
  ui.draw_by = ui.now;  // it fades
  for (std::size_t k = 1; k < stroke.size(); ++k)
    if (!stroke[k].begins) stroke_part(ui, draw, stroke[k - 1], stroke[k]);
}

void first_cut_hint(Ui& ui, ImDrawList& draw) {
  if (ui.cut_hint && ui.now >= ui.cut_hint->until) ui.cut_hint.reset();
  if (!ui.cut_hint) return;
  ui.draw_by = std::min(ui.draw_by, ui.cut_hint->until);
  const ImFont& font = *ui.fonts.text;
  const char* const words =
      ui.input.by_touch ? "You cut the cloth. Undo reverts the cut." : "Right drag pulls. Ctrl+Z undoes the cut.";
  const float pad = ui.theme.px(10);
  const auto box = place_of_label(ui, ui.cut_hint->at,
                                  glm::ceil(glm::vec2(text_width(font, words) + 2 * pad, font.FontSize + 1.4f * pad)));
  if (!box) return;
  ui.placing.take("cut", *box);
  draw.AddRectFilled(vec(box->lo), vec(box->hi), ui.theme.colors.panel, ui.theme.px(6));
  draw.AddRect(vec(box->lo), vec(box->hi), ui.theme.colors.accent, ui.theme.px(6));
  draw_text(draw, font, vec(box->lo + glm::vec2(pad, 0.7f * pad)), ui.theme.colors.text, words);
}

void springs_to_cut(Ui& ui, ImDrawList& draw) {
  const int tile = ui.viewport.tile_at(ui.input.at);
  const Tokens& c = ui.theme.colors;
  for (const SpringSite& spring : springs_under_pointer(ui.tools)) {
    const Direction& d = directions[std::size_t(spring.direction)];
    const auto a = particle_on_screen(ui, tile, {spring.i, spring.j}),
               b = particle_on_screen(ui, tile, {spring.i + d.di, spring.j + d.dj});
    if (!a || !b) continue;
    draw.AddLine(*a, *b, faded(c.ground, 0.6f), ui.theme.px(4));
    draw.AddLine(*a, *b, c.magenta, ui.theme.px(2));
  }
}

}  // namespace tyglab
