// What is drawn over the cloth: what would be grabbed or cut, the picked particle with its forces, PAUSED.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "app/panels/curves.h"
#include "app/panels/panels.h"
#include "app/panels/symbol.h"
#include "app/panels/widgets.h"

namespace tyglab {
namespace {

ImVec2 vec(glm::vec2 v) {
  return {v.x, v.y};
}

/// Pixel in the window of a place in a picture, if it is before the camera.
std::optional<ImVec2> on_screen(const App& app, int tile, glm::dvec3 world) {
  const auto pixel = app.camera.project(world, app.viewport.size());
  if (!pixel || !std::isfinite(pixel->x) || !std::isfinite(pixel->y) || std::abs(pixel->x) > 1e5f ||
      std::abs(pixel->y) > 1e5f)
    return std::nullopt;
  return vec(*pixel + app.viewport.origin(tile));
}

std::optional<ImVec2> particle_on_screen(App& app, int tile, Pins::Site site) {
  return on_screen(app, tile, cloth_in_tile(app, tile).positions().at(site.i, site.j));
}

void ring(App& app, ImDrawList& draw, ImVec2 at, float radius, ImU32 color, float width) {
  // A dark rim keeps it visible on a light cloth.
  draw.AddCircle(at, app.theme.px(radius), faded(app.theme.colors.ground, 0.6f), 32, app.theme.scale * (width + 2));
  draw.AddCircle(at, app.theme.px(radius), color, 32, app.theme.scale * width);
}

/// `labels`: the middles of those drawn before.
void arrow(App& app, ImDrawList& draw, ImVec2 from, ImVec2 to, std::string_view key, std::vector<ImVec2>& labels) {
  const CurveStyle style = curve_style(app.theme.colors, key);
  const float dx = to.x - from.x, dy = to.y - from.y, length = std::hypot(dx, dy);
  if (length < app.theme.px(10)) return;
  const float ux = dx / length, uy = dy / length, head = app.theme.px(9);
  const ImVec2 neck{to.x - ux * head, to.y - uy * head};
  draw.AddLine(from, neck, faded(app.theme.colors.ground, 0.55f), app.theme.px(5));
  const ImVec2 line[2] = {from, neck};
  CurveStyle thick = style;
  thick.width = 2.6f;
  draw_styled_line(draw, line, 2, thick, app.theme.scale);
  draw.AddTriangleFilled(to, {neck.x - uy * head * 0.5f, neck.y + ux * head * 0.5f},
                         {neck.x + uy * head * 0.5f, neck.y - ux * head * 0.5f}, style.color);
  if (length < app.theme.px(24)) return;
  const float width = symbol_width(app.fonts, key), away = app.theme.px(18), high = app.theme.px(12),
              pad = app.theme.px(7);
  ImVec2 middle{std::round(to.x + ux * away), std::round(to.y + uy * away)};
  // Labels of arrows that point the same way make room for each other, farther out.
  const auto covered = [&](ImVec2 other) {
    return std::abs(other.x - middle.x) < width + 2 * pad && std::abs(other.y - middle.y) < 2 * high + 1;
  };
  while (std::any_of(labels.begin(), labels.end(), covered)) middle.x += ux, middle.y += uy;
  middle = {std::round(middle.x), std::round(middle.y)};
  labels.push_back(middle);
  draw.AddRectFilled({middle.x - width / 2 - pad, middle.y - high}, {middle.x + width / 2 + pad, middle.y + high},
                     faded(app.theme.colors.ground, 0.88f), app.theme.px(6));
  draw_symbol(draw, app.fonts, {middle.x - width / 2, middle.y + app.theme.px(4)}, key, app.theme.colors.text);
}

/// F_s, F_b, F_d, F_g to one scale: the longest of the original's takes about 90 pixels. The scale moves slowly, so
/// that growth is seen.
void force_arrows(App& app, ImDrawList& draw, int tile, ImVec2 from) {
  const ParticleReadout r = cloth_in_tile(app, tile).particle(app.picked->i, app.picked->j);
  const std::pair<std::string_view, glm::dvec3> forces[] = {
      {"F_s", r.F_s}, {"F_b", r.F_b}, {"F_d", r.F_d}, {"F_g", r.F_g}};
  double longest = 0;
  for (const auto& [key, force] : forces) longest = std::max(longest, glm::length(force));
  if (!std::isfinite(longest) || longest <= 0) return;
  double& scale = app.ui.arrow_scale;
  // The scale follows within half a second, and at once where arrows would leave the picture or vanish.
  const double follow = 1 - std::exp(-double(ImGui::GetIO().DeltaTime) / 0.5);
  if (tile == 0 || scale <= 0) {
    const bool far = longest > 3 * scale || longest < scale / 20;
    scale = far ? longest : scale + follow * (longest - scale);
    if (std::abs(longest - scale) > 0.01 * scale) app.ui.draw_by = app.ui.now;
  }
  const double depth = glm::dot(r.x - glm::dvec3(app.camera.eye()), glm::dvec3(app.camera.forward()));
  const double metres_per_pixel = 2 * depth * std::tan(app.camera.fov_y / 2) / app.viewport.size().y;
  std::vector<ImVec2> labels;
  for (const auto& [key, force] : forces) {
    const double pixels = std::min(glm::length(force) / scale, 1.6) * app.theme.px(90);
    if (pixels < 1) continue;
    if (const auto to = on_screen(app, tile, r.x + glm::normalize(force) * pixels * metres_per_pixel))
      arrow(app, draw, from, *to, key, labels);
  }
}

/// While its step is written out: what every spring does to the particle, the strongest drawn about 80 pixels long.
void spring_arrows(App& app, ImDrawList& draw, ImVec2 from) {
  const StepTrace* trace = app.inside.shown();
  if (trace == nullptr) return;
  const std::vector<SpringForce>& springs = trace->stages.front().springs;
  double strongest = 0;
  for (const SpringForce& spring : springs) strongest = std::max(strongest, glm::length(spring.F));
  const glm::dvec3 x = app.simulation->positions().at(trace->i, trace->j);
  const double depth = glm::dot(x - glm::dvec3(app.camera.eye()), glm::dvec3(app.camera.forward()));
  const double metres = 2 * depth * std::tan(app.camera.fov_y / 2) / app.viewport.size().y * app.theme.px(80);
  for (const SpringForce& spring : springs) {
    if (!(glm::length(spring.F) > 0.02 * strongest)) continue;
    const auto to = on_screen(app, 0, x + spring.F / strongest * metres);
    if (!to) continue;
    const ImU32 color = curve_style(app.theme.colors, spring.bending ? "F_b" : "F_s").color;
    draw.AddLine(from, *to, faded(app.theme.colors.ground, 0.55f), app.theme.px(4));
    draw.AddLine(from, *to, color, app.theme.px(1.6f));
    draw.AddCircleFilled(*to, app.theme.px(2.5f), color, 12);
  }
}

void picked(App& app, ImDrawList& draw) {
  if (!app.picked || app.preset().kind != Kind::cloth) return;
  for (int tile = 0; tile < app.copies.tiles(); ++tile) {
    const auto at = particle_on_screen(app, tile, *app.picked);
    if (!at) continue;
    const glm::vec2 lo = app.viewport.origin(tile), hi = lo + app.viewport.size();
    draw.PushClipRect(vec(lo), vec(hi), true);  // what points far stays in its own picture
    if (tile == 0) spring_arrows(app, draw, *at);
    if (app.ui.force_arrows && !cloth_in_tile(app, tile).divergence()) force_arrows(app, draw, tile, *at);
    ring(app, draw, *at, 7, app.theme.colors.text, 2);
    draw.PopClipRect();
  }
}

/// The pointer with its tool, and the particle that it would take.
void pointer(App& app, ImDrawList& draw) {
  const Tokens& c = app.theme.colors;
  const ImVec2 mouse = vec(app.input.at);
  const float r = app.theme.px(8);
  switch (app.tool.kind) {
    case Tool::Kind::cut: {
      ImGui::SetMouseCursor(ImGuiMouseCursor_None);
      const char* scissors = icon_or(app.fonts, icon::scissors, "×");
      draw_text(draw, *app.fonts.large_icons, {mouse.x - r + 1, mouse.y - r + 1}, c.ground, scissors);
      draw_text(draw, *app.fonts.large_icons, {mouse.x - r, mouse.y - r}, c.magenta, scissors);
      return;
    }
    case Tool::Kind::grab:
      if (const auto held = app.simulation->held())
        if (const auto at = particle_on_screen(app, app.tool.tile, *held)) {
          if (std::hypot(at->x - mouse.x, at->y - mouse.y) > r)
            draw.AddLine(*at, mouse, faded(c.accent, 0.8f), app.theme.px(1.5f));
          ring(app, draw, *at, 10, c.accent, 2.5f);
          draw.AddCircleFilled(*at, app.theme.px(3.5f), c.accent, 16);
        }
      return;
    case Tool::Kind::orbit:
    case Tool::Kind::pan:
    case Tool::Kind::body:
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
      return;
    case Tool::Kind::right:
    case Tool::Kind::none:
      break;
  }
  if (app.preset().kind != Kind::cloth) return;
  if (body_under_pointer(app)) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    return;
  }
  if (const auto site = particle_under_pointer(app)) {
    const int tile = app.viewport.tile_at(app.input.at);
    app.colors.under_pointer = app.colors.value(tile, *site);
    if (const auto at = particle_on_screen(app, tile, *site)) {
      const bool pinned = app.simulation->pinned(site->i, site->j);
      ring(app, draw, *at, 5, pinned ? c.warning : c.accent, 2);
    }
  }
}

/// How to go on from a pause: the keys that reach the transport now.
const char* ways_on(const App& app) {
  if (app.ui.slider.typing != 0 || ImGui::GetIO().WantTextInput) return "Enter takes what is typed · Esc leaves it";
  if (app.ui.slider.focused != 0) return "Space runs · O makes one step · → is the slider's until Esc";
  return "Space runs · → makes one step";
}

void paused(App& app, ImDrawList& draw) {
  if (app.pacing.playing || app.simulation->divergence()) return;
  const Tokens& c = app.theme.colors;
  const char* word = "PAUSED";
  const glm::vec2 lo = app.viewport.box.lo, hi = app.viewport.box.hi;
  const float room = hi.x - lo.x - app.theme.px(32);
  const bool wide = text_width(*app.fonts.huge, word) <= room;
  const ImFont &font = wide ? *app.fonts.huge : *app.fonts.title, &small = *app.fonts.text;
  const auto centred = [&](const ImFont& of, const char* text) {
    return std::round((lo.x + hi.x - text_width(of, text)) / 2);
  };
  const float y = lo.y + app.theme.px(52);
  draw_text(draw, font, {centred(font, word), y}, faded(c.text, 0.75f), word);
  const char* how = ways_on(app);
  const float pad = app.theme.px(8), width = text_width(small, how);
  if (width + 2 * pad > room) return;
  // On a ground of its own, since a light cloth may hang behind it.
  const ImVec2 at{centred(small, how), y + font.FontSize + app.theme.px(6)};
  draw.AddRectFilled({at.x - pad, at.y - pad / 2}, {at.x + width + pad, at.y + small.FontSize + pad / 2},
                     faded(c.ground, 0.7f), app.theme.px(6));
  draw_text(draw, small, at, c.text, how);
}

}  // namespace

void viewport_overlay(App& app) {
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  picked(app, draw);
  app.colors.under_pointer.reset();
  pointer(app, draw);
  paused(app, draw);
}

}  // namespace tyglab
