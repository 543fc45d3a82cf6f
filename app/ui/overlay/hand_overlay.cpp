// The hand's tools over the cloth: the wind's arrow, the knife's stroke and what it would cut.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>

#include "app/base/numbers.h"
#include "app/tools/knife.h"
#include "app/tools/wind_arrow.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/overlay/overlay.h"

namespace tyglab {
namespace {

constexpr double stroke_seen = 0.7;  // s

/// Where a label of that size can stand: under the foot of the arrow, over it, or beside it.
std::optional<Box> place_of_label(const App& app, glm::vec2 foot, glm::vec2 size) {
  const float away = app.theme.px(22), margin = app.theme.px(8);
  const glm::vec2 lo = app.viewport.origin(0) + margin, hi = app.viewport.origin(0) + app.viewport.size() - margin;
  std::vector<Box> places;
  for (const glm::vec2 at : {foot + glm::vec2(-size.x / 2, away), foot + glm::vec2(-size.x / 2, -away - size.y),
                             foot + glm::vec2(away, -size.y / 2), foot + glm::vec2(-away - size.x, -size.y / 2),
                             foot + glm::vec2(-size.x / 2, -2 * away - 2 * size.y)}) {
    const glm::vec2 inside = glm::round(glm::max(lo, glm::min(at, hi - size)));
    places.push_back({inside, inside + size});
  }
  return app.ui.placing.first_free(places);
}

/// "W  4.02e-3 N", and in gusts what blows now.
void wind_label(App& app, ImDrawList& draw, glm::vec2 foot, const glm::dvec3& W) {
  const Tokens& c = app.theme.colors;
  const ImFont &mono = *app.fonts.mono, &small = *app.fonts.small;
  const float pad = app.theme.px(8), gap = app.theme.px(8), line = app.theme.px(20);
  const std::string strength = short_number(glm::length(W)) + " N";
  const bool gusty = gusts(app.preset());
  const std::string now = "now " + steady_number(glm::length(app.simulation->wind())) + " N";
  const float symbol = symbol_width(app.fonts, "W");
  const float width = std::max(symbol + gap + text_width(mono, strength), gusty ? text_width(small, now) : 0.f);
  const glm::vec2 size = glm::ceil(glm::vec2(width + 2 * pad, line * (gusty ? 2.f : 1.f) + pad / 2));
  const auto box = place_of_label(app, foot, size);
  if (!box) return;
  app.ui.placing.take("wind", *box);
  draw.AddRectFilled(vec(box->lo), vec(box->hi), faded(c.ground, 0.85f), app.theme.px(6));
  const float x = box->lo.x + pad, baseline = baseline_at(app.fonts, box->lo.y + line / 2 + pad / 4);
  draw_symbol(draw, app.fonts, {x, baseline}, "W", c.text);
  draw_on_baseline(draw, mono, {x + symbol + gap, baseline}, c.text, strength);
  if (gusty) draw_on_baseline(draw, small, {x, baseline + line}, c.quiet, now);
}

void stroke_part(App& app, ImDrawList& draw, const Tool::StrokePoint& a, const Tool::StrokePoint& b) {
  const float left = float(1 - (app.ui.now - b.time) / stroke_seen);
  const glm::vec2 origin = app.viewport.origin(b.tile);
  draw.AddLine(vec(origin + a.at), vec(origin + b.at), faded(app.theme.colors.ground, 0.5f * left), app.theme.px(5));
  draw.AddLine(vec(origin + a.at), vec(origin + b.at), faded(app.theme.colors.magenta, left), app.theme.px(2.5f));
}

}  // namespace

void wind_overlay(App& app, ImDrawList& draw) {
  if (!wind_arrow_shown(app)) return;
  const Tokens& c = app.theme.colors;
  const glm::dvec3 W = app.requested_preset().W;
  const WindArrow arrow = wind_arrow(app, W);
  const auto base = on_screen(app, 0, arrow.base), tip = on_screen(app, 0, arrow.tip);
  if (!base || !tip) return;
  const bool taken = app.tool.kind == Tool::Kind::wind, near = wind_under_pointer(app);
  if (gusts(app.preset())) {
    const auto now = on_screen(app, 0, wind_arrow(app, app.simulation->wind()).tip);
    if (now) draw_arrow(app, draw, *base, *now, {faded(c.sky, 0.5f), LineStyle::solid, 2});
  }
  ImVec2 end = *tip;
  const bool shortened = keep_in_picture(app, 0, *base, end) ||
                         glm::length(arrow.tip - arrow.base) < 0.999 * glm::length(W) * arrow.metres_per_newton;
  draw_arrow(app, draw, *base, end, {c.sky, LineStyle::solid, 2}, shortened);
  draw.AddCircleFilled(*base, app.theme.px(3), c.sky, 16);
  ring(app, draw, end, 8, taken || near ? c.accent : faded(c.sky, 0.7f), taken || near ? 2.5f : 1.5f);
  wind_label(app, draw, {base->x, base->y}, W);
}

void knife_stroke(App& app, ImDrawList& draw) {
  auto& stroke = app.tool.stroke;
  if (!app.settings.handling.cut_along_path) stroke.clear();
  std::erase_if(stroke, [&](const Tool::StrokePoint& point) {
    return app.ui.now - point.time > stroke_seen || point.tile >= app.copies.tiles();
  });
  if (stroke.empty()) return;
  app.ui.draw_by = app.ui.now;  // it fades
  for (std::size_t k = 1; k < stroke.size(); ++k)
    if (!stroke[k].begins) stroke_part(app, draw, stroke[k - 1], stroke[k]);
}

void springs_to_cut(App& app, ImDrawList& draw) {
  const int tile = app.viewport.tile_at(app.input.at);
  const Tokens& c = app.theme.colors;
  for (const SpringSite& spring : springs_under_pointer(app)) {
    const Direction& d = directions[std::size_t(spring.direction)];
    const auto a = particle_on_screen(app, tile, {spring.i, spring.j}),
               b = particle_on_screen(app, tile, {spring.i + d.di, spring.j + d.dj});
    if (!a || !b) continue;
    draw.AddLine(*a, *b, faded(c.ground, 0.6f), app.theme.px(4));
    draw.AddLine(*a, *b, c.magenta, app.theme.px(2));
  }
}

}  // namespace tyglab
