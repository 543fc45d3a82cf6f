// What is drawn over the cloth: what would be grabbed or cut, the picked particle with its forces.
#include "app/ui/overlay/overlay.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "app/ui/frame/panels.h"
#include "app/ui/kit/curves.h"
#include "app/ui/kit/symbol.h"
#include "app/ui/kit/widgets.h"

namespace tyglab {
namespace {

/// While its step is written out: what every spring does to the particle, the strongest drawn about 80 pixels long.
void spring_arrows(App& app, ImDrawList& draw, ImVec2 from) {
  const StepTrace* trace = app.inside.shown();
  if (trace == nullptr) return;
  const std::vector<SpringForce>& springs = trace->stages.front().springs;
  double strongest = 0;
  for (const SpringForce& spring : springs) strongest = std::max(strongest, glm::length(spring.F));
  const glm::dvec3 x = app.simulation->position(trace->i, trace->j);
  const double metres = app.camera.metres_per_pixel(x, app.viewport.size().y) * app.theme.px(80);
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

}  // namespace

void picked_overlay(App& app, ImDrawList& draw) {
  if (!app.picked || app.preset().kind != Kind::cloth) return;
  for (int tile = 0; tile < app.copies.tiles(); ++tile) {
    const auto at = particle_on_screen(app, tile, *app.picked);
    if (!at) continue;
    const glm::vec2 lo = app.viewport.origin(tile), hi = lo + app.viewport.size();
    draw.PushClipRect(vec(lo), vec(hi), true);  // what points far stays in its own picture
    if (tile == 0) spring_arrows(app, draw, *at);
    if (app.ui.arrows && !cloth_in_tile(app, tile).divergence()) particle_arrows(app, draw, tile, *at);
    ring(app, draw, *at, 7, app.theme.colors.text, 2);
    draw.PopClipRect();
  }
}

void pointer_overlay(App& app, ImDrawList& draw) {
  app.colors.under_pointer.reset();
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
    case Tool::Kind::wind:
      ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeAll);
      return;
    case Tool::Kind::right:
    case Tool::Kind::none:
      break;
  }
  if (app.preset().kind != Kind::cloth) return;
  if (wind_under_pointer(app) || body_under_pointer(app)) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    return;
  }
  if (app.settings.handling.cut_along_path) springs_to_cut(app, draw);
  if (const auto site = particle_under_pointer(app)) {
    const int tile = app.viewport.tile_at(app.input.at);
    app.colors.under_pointer = app.colors.value(tile, *site);
    if (const auto at = particle_on_screen(app, tile, *site)) {
      const bool pinned = app.simulation->pinned(site->i, site->j);
      ring(app, draw, *at, 5, pinned ? c.warning : c.accent, 2);
    }
  }
}

}  // namespace tyglab
