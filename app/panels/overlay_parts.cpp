// What all that is drawn over the cloth is made of.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "app/panels/overlay.h"

namespace tyglab {

std::optional<ImVec2> on_screen(const App& app, int tile, glm::dvec3 world) {
  const auto pixel = app.camera.project(world, app.viewport.size());
  if (!pixel || !std::isfinite(pixel->x) || !std::isfinite(pixel->y) || std::abs(pixel->x) > 1e5f ||
      std::abs(pixel->y) > 1e5f)
    return std::nullopt;
  return vec(*pixel + app.viewport.origin(tile));
}

std::optional<ImVec2> particle_on_screen(App& app, int tile, Pins::Site site) {
  return on_screen(app, tile, cloth_in_tile(app, tile).position(site.i, site.j));
}

void ring(App& app, ImDrawList& draw, ImVec2 at, float radius, ImU32 color, float width) {
  // A dark rim keeps it visible on a light cloth.
  draw.AddCircle(at, app.theme.px(radius), faded(app.theme.colors.ground, 0.6f), 32, app.theme.scale * (width + 2));
  draw.AddCircle(at, app.theme.px(radius), color, 32, app.theme.scale * width);
}

bool draw_arrow(App& app, ImDrawList& draw, ImVec2 from, ImVec2 to, const CurveStyle& style, bool cut_short) {
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (length < app.theme.px(10)) return false;
  const float ux = dx / length, uy = dy / length, head = app.theme.px(9);
  const ImVec2 neck{to.x - ux * head, to.y - uy * head};
  draw.AddLine(from, neck, faded(app.theme.colors.ground, 0.55f), app.theme.px(5));
  const ImVec2 line[2] = {from, neck};
  CurveStyle thick = style;
  thick.width = 2.6f;
  draw_styled_line(draw, line, 2, thick, app.theme.scale);
  const ImVec2 left{neck.x - uy * head * 0.5f, neck.y + ux * head * 0.5f},
      right{neck.x + uy * head * 0.5f, neck.y - ux * head * 0.5f};
  if (cut_short)
    draw.AddTriangle(to, left, right, style.color, std::max(1.f, app.theme.px(1.5f)));
  else
    draw.AddTriangleFilled(to, left, right, style.color);
  return true;
}

bool keep_in_picture(const App& app, int tile, ImVec2 from, ImVec2& to) {
  const float margin = app.theme.px(6);
  const glm::vec2 lo = app.viewport.origin(tile) + margin, hi = lo + app.viewport.size() - 2 * margin;
  float part = 1;
  const auto keep = [&](float begin, float end, float least, float most) {
    if (end > most) part = std::min(part, std::max((most - begin) / (end - begin), 0.f));
    if (end < least) part = std::min(part, std::max((least - begin) / (end - begin), 0.f));
  };
  keep(from.x, to.x, lo.x, hi.x), keep(from.y, to.y, lo.y, hi.y);
  to = {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)};
  return part < 1;
}

}  // namespace tyglab
