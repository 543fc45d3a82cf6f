#include "app/tools/pointer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "app/render/picking.h"
#include "app/shell/window.h"
#include "app/tools/knife.h"
#include "app/tools/wind_arrow.h"
#include "app/ui/app.h"
#include "core/engines/vertex_sharing.h"

namespace tyglab {
namespace {

constexpr float click_slack = 4;         // pixels at scale 1
constexpr float double_click_slack = 8;  // between the two presses of a double click

using ToolKind = Tool::Kind;

std::optional<Pins::Site> nearest_site(App& app, int tile, glm::vec2 at, bool free_only) {
  Simulation& simulation = cloth_in_tile(app, tile);
  const auto skip = [&](int i, int j) { return free_only && simulation.pinned(i, j); };
  const auto hit =
      nearest_particle(simulation.positions(), app.camera, at, app.viewport.size(), pointer_reach(app), skip);
  if (!hit) return std::nullopt;
  return Pins::Site{hit->i, hit->j};
}

std::optional<Pins::Site> nearest_of_all(App& app, int tile, glm::vec2 at) {
  return nearest_site(app, tile, at, false);
}

/// The same for a pointer that has pressed nothing. Where that would copy the whole cloth from a
/// graphics card it is not looked for in every frame: what was found counts while it stays near enough, and nothing
/// until the pointer moves.
std::optional<Pins::Site> site_under(App& app, int tile, glm::vec2 at) {
  Simulation& simulation = cloth_in_tile(app, tile);
  if (!is_remote(simulation.engine())) return nearest_of_all(app, tile, at);
  Tool::Rest& rest = app.tool.rest;
  if (rest.at != at || rest.tile != tile || !(rest.camera == app.camera))
    rest = {at, tile, app.camera, nearest_of_all(app, tile, at)};
  if (!rest.site || !simulation.lattice().contains(rest.site->i, rest.site->j)) return std::nullopt;
  const auto pixel = app.camera.project(simulation.position(rest.site->i, rest.site->j), app.viewport.size());
  if (!pixel || !(glm::distance(*pixel, at) <= pointer_reach(app))) rest.site.reset();
  return rest.site;
}

/// The body that a press means, where `nearest` finds a particle: one that no cloth hangs in front of. Cloth that
/// rests on it does not hide it.
std::optional<int> body_pressed(App& app, int tile, glm::vec2 at,
                                std::optional<Pins::Site> (*nearest)(App&, int, glm::vec2)) {
  const std::vector<Body>& bodies = app.preset().bodies;
  const auto body = body_under(bodies, app.camera, at, app.viewport.size());
  if (!body) return std::nullopt;
  const std::optional<Pins::Site> site = nearest(app, tile, at);
  if (!site) return body;
  const glm::dvec3 eye(app.camera.eye());
  const glm::dvec3 ray = app.camera.ray(at, app.viewport.size());
  const double r = bodies[*body].r;
  const auto surface = sphere_surface(eye, ray, bodies[*body].c, r);
  const double particle = glm::dot(ray, cloth_in_tile(app, tile).position(site->i, site->j) - eye);
  const double resting = std::max(3 * app.preset().L, 0.15 * r);
  return surface && particle > *surface - resting ? body : std::nullopt;
}

void start_left(App& app, glm::vec2 at) {
  Tool& tool = app.tool;
  if (const auto body = body_pressed(app, tool.tile, at, nearest_of_all)) {
    tool.kind = ToolKind::body;
    tool.body = *body;
    tool.body_plane = app.preset().bodies[*body].c;
    tool.body_offset = tool.body_plane - app.camera.unproject_in_camera_plane(at, tool.body_plane, app.viewport.size());
  } else {
    tool.kind = ToolKind::cut;
    tool.path = {at};
    tool.stroke.push_back({at, app.ui.now, tool.tile, true});
  }
}

/// Whether a right press comes soon and near enough after a click on a particle to be the second half of a double
/// click.
bool follows_click(const App& app, const PointerEvent& event, glm::vec2 at) {
  const Tool& tool = app.tool;
  return tool.last_site && event.time - tool.last_click < app.input.double_click_s &&
         glm::length(at - tool.last_press) <= app.theme.px(double_click_slack);
}

void start(App& app, const PointerEvent& event) {
  Tool& tool = app.tool;
  tool.tile = app.viewport.tile_at(event.at);
  const glm::vec2 at = event.at - app.viewport.origin(tool.tile);
  tool.button = event.button;
  tool.press = tool.at = at;
  tool.press_time = event.time;
  const bool shift = (event.mods & GLFW_MOD_SHIFT) != 0, control = (event.mods & GLFW_MOD_CONTROL) != 0;
  if (event.button == GLFW_MOUSE_BUTTON_LEFT && tool.tile == 0 && on_wind_tip(app, at)) {
    take_wind(app);
  } else if (event.button == GLFW_MOUSE_BUTTON_MIDDLE || (event.button == GLFW_MOUSE_BUTTON_LEFT && control)) {
    tool.kind = shift ? ToolKind::pan : ToolKind::orbit;
  } else if (event.button == GLFW_MOUSE_BUTTON_LEFT) {
    start_left(app, at);
  } else if (event.button == GLFW_MOUSE_BUTTON_RIGHT) {
    tool.kind = ToolKind::right;
    tool.second_press = follows_click(app, event, at);
    // A swinging cloth has carried the particle away by now: the one that was clicked first is meant.
    tool.site = tool.second_press ? tool.last_site : nearest_of_all(app, tool.tile, at);
  }
}

void start_grab(App& app) {
  Tool& tool = app.tool;
  const auto site = nearest_site(app, tool.tile, tool.press, true);
  if (!site || !apply_edit(app, edit::Grab{site->i, site->j})) {
    tool.kind = ToolKind::none;
    return;
  }
  tool.kind = ToolKind::grab;
  tool.site = site;
  if (app.picked != site) app.picked = site, app.ui.plots.forces.clear();
}

void pick_or_pin(App& app, const PointerEvent& event) {
  Tool& tool = app.tool;
  if (tool.second_press && tool.site) {
    const auto [i, j] = *tool.site;
    apply_edit(app, edit::Pin{i, j, !app.simulation->pinned(i, j)});
    tool.last_site.reset();
    return;
  }
  if (app.picked != tool.site && app.ui.plots.source == Source::particle) app.ui.plots.forces.clear();
  app.picked = tool.site;
  tool.last_click = event.time;
  tool.last_press = tool.press;
  tool.last_site = tool.site;
}

void finish(App& app, const PointerEvent& event) {
  Tool& tool = app.tool;
  if (tool.kind == ToolKind::grab) apply_edit(app, edit::Release{});
  if (tool.kind == ToolKind::right) pick_or_pin(app, event);
  tool.kind = ToolKind::none;
}

void drag(App& app, glm::vec2 at) {
  Tool& tool = app.tool;
  const glm::vec2 moved = at - tool.at;
  tool.at = at;
  if (tool.kind == ToolKind::orbit || tool.kind == ToolKind::pan) app.camera_by_hand |= moved != glm::vec2(0);
  switch (tool.kind) {
    case ToolKind::orbit:
      app.camera.orbit(moved.x, moved.y);
      break;
    case ToolKind::pan:
      app.camera.pan(moved.x, moved.y, app.viewport.size().y);
      break;
    case ToolKind::cut:
      tool.path.push_back(at);
      tool.stroke.push_back({at, app.ui.now, tool.tile, false});
      break;
    case ToolKind::right:
      if (glm::length(at - tool.press) > app.theme.px(click_slack)) start_grab(app);
      break;
    case ToolKind::none:
    case ToolKind::grab:
    case ToolKind::body:
    case ToolKind::wind:
      break;
  }
}

void wheel(App& app, const PointerEvent& event) {
  if (!app.viewport.takes(event.at)) return;
  app.camera_by_hand = true;
  if ((event.mods & GLFW_MOD_SHIFT) != 0) {
    app.camera.pan(event.wheel.x * app.theme.px(32), event.wheel.y * app.theme.px(32), app.viewport.size().y);
  } else {
    app.camera.zoom(event.wheel.y);
  }
}

void move_body(App& app) {
  Tool& tool = app.tool;
  if (tool.body < 0 || std::size_t(tool.body) >= app.preset().bodies.size()) {
    tool.kind = ToolKind::none;
    return;
  }
  const glm::dvec3 pointer = app.camera.unproject_in_camera_plane(tool.at, tool.body_plane, app.viewport.size());
  const glm::dvec3 to = glm::clamp(pointer + tool.body_offset, glm::dvec3(-1e3), glm::dvec3(1e3));
  if (to != app.preset().bodies[tool.body].c) apply_edit(app, edit::MoveBody{tool.body, to}, unsigned(tool.body) + 1);
}

/// What a held tool does every frame, whether the pointer moved or not.
void hold(App& app) {
  Tool& tool = app.tool;
  // Held still for longer than a click takes.
  if (tool.kind == ToolKind::right && tool.site && app.ui.now - tool.press_time > app.input.double_click_s)
    start_grab(app);
  if (tool.kind == ToolKind::cut) use_knife(app);
  if (tool.kind == ToolKind::body) move_body(app);
  if (tool.kind == ToolKind::wind) drag_wind(app);
  if (tool.kind != ToolKind::grab) return;
  const auto held = app.simulation->held();
  if (!held) {
    tool.kind = ToolKind::none;
    return;
  }
  const glm::dvec3 through = cloth_in_tile(app, tool.tile).position(held->i, held->j);
  tool.hand = app.camera.unproject_in_camera_plane(tool.at, through, app.viewport.size());
}

}  // namespace

float pointer_reach(const App& app) {
  return app.theme.px(24);
}

int Viewport::tile_at(glm::vec2 p) const {
  const glm::vec2 inside = (p - box.lo) / glm::max(size(), glm::vec2(1));
  return std::clamp(int(inside.y), 0, rows - 1) * columns + std::clamp(int(inside.x), 0, columns - 1);
}

void Viewport::divide(int pictures) {
  // The division whose pictures are nearest to square.
  const glm::vec2 whole = box.hi - box.lo;
  float best = std::numeric_limits<float>::infinity();
  for (int across = 1; across <= pictures; ++across) {
    const int down = (pictures + across - 1) / across;
    if (across * down - pictures >= across) continue;  // an empty row
    const float shape = std::abs(std::log(whole.x / float(across) / std::max(whole.y / float(down), 1.f)));
    if (shape < best) best = shape, columns = across, rows = down;
  }
}

Simulation& cloth_in_tile(App& app, int tile) {
  return cloth_of(app, tile < app.copies.tiles() ? tile - 1 : Copies::original);
}

void handle_pointer(App& app) {
  Tool& tool = app.tool;
  for (const PointerEvent& event : app.input.pointer) {
    const glm::vec2 at = event.at - app.viewport.origin(tool.tile);
    switch (event.type) {
      case PointerEvent::Type::press:
        if (tool.kind == ToolKind::none && app.viewport.takes(event.at)) start(app, event);
        break;
      case PointerEvent::Type::move:
        drag(app, at);
        break;
      case PointerEvent::Type::release:
        if (tool.kind == ToolKind::none || event.button != tool.button) break;
        drag(app, at);
        hold(app);
        finish(app, event);
        break;
      case PointerEvent::Type::wheel:
        wheel(app, event);
        break;
    }
  }
  hold(app);
}

std::optional<Pins::Site> particle_under_pointer(App& app) {
  if (app.tool.kind != ToolKind::none || !app.viewport.takes(app.input.at)) return std::nullopt;
  const int tile = app.viewport.tile_at(app.input.at);
  return site_under(app, tile, app.input.at - app.viewport.origin(tile));
}

bool wind_under_pointer(const App& app) {
  if (app.tool.kind != ToolKind::none || !app.viewport.takes(app.input.at)) return false;
  return app.viewport.tile_at(app.input.at) == 0 && on_wind_tip(app, app.input.at - app.viewport.origin(0));
}

bool hand_in_cloth(const App& app) {
  return app.tool.kind == ToolKind::grab || app.tool.kind == ToolKind::cut;
}

bool body_under_pointer(App& app) {
  if (app.tool.kind != ToolKind::none || !app.viewport.takes(app.input.at)) return false;
  const int tile = app.viewport.tile_at(app.input.at);
  return body_pressed(app, tile, app.input.at - app.viewport.origin(tile), site_under).has_value();
}

void move_hand(App& app, int steps) {
  if (app.tool.kind != ToolKind::grab || steps <= 0) return;
  apply_edit(app, edit::MoveHand{app.tool.hand, steps});
}

}  // namespace tyglab
