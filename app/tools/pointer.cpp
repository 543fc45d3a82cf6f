#include "app/tools/pointer.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "app/base/glfw_keys.h"
#include "app/render/picking.h"
#include "app/session/session.h"
#include "app/tools/tools.h"
#include "core/engines/vertex_sharing.h"
#include "core/forces/contact.h"

namespace tyglab {
namespace {

constexpr unsigned first_knife_gesture = 0x78000000;  // apart from those of sliders, bodies and the wind
constexpr float click_slack = 4;                      // pixels at scale 1
constexpr float double_click_slack = 8;               // between the two presses of a double click

using ToolKind = Tool::Kind;

std::optional<Pins::Site> nearest_site(Tools& tools, int tile, glm::vec2 at, bool free_only) {
  Simulation& simulation = cloth_in_tile(tools.scene, tile);
  const auto skip = [&](int i, int j) { return free_only && simulation.pinned(i, j); };
  const auto hit = nearest_particle(simulation.positions(), tools.scene.camera, at, tools.scene.viewport.size(),
                                    pointer_reach(tools), skip);
  if (!hit) return std::nullopt;
  return Pins::Site{hit->i, hit->j};
}

std::optional<Pins::Site> nearest_of_all(Tools& tools, int tile, glm::vec2 at) {
  return nearest_site(tools, tile, at, false);
}

/// The same for a pointer that has pressed nothing. Where that would copy the whole cloth from a
/// graphics card it is not looked for in every frame: what was found counts while it stays near enough, and nothing
/// until the pointer moves.
std::optional<Pins::Site> site_under(Tools& tools, int tile, glm::vec2 at) {
  Simulation& simulation = cloth_in_tile(tools.scene, tile);
  if (!is_remote(simulation.engine())) return nearest_of_all(tools, tile, at);
  Tool::Rest& rest = tools.tool.rest;
  if (rest.at != at || rest.tile != tile || !(rest.camera == tools.scene.camera))
    rest = {at, tile, tools.scene.camera, nearest_of_all(tools, tile, at)};
  if (!rest.site || !simulation.has(rest.site->i, rest.site->j)) return std::nullopt;
  const auto pixel =
      tools.scene.camera.project(simulation.position(rest.site->i, rest.site->j), tools.scene.viewport.size());
  if (!pixel || !(glm::distance(*pixel, at) <= pointer_reach(tools))) rest.site.reset();
  return rest.site;
}

/// The body that a press means, where `nearest` finds a particle: one that no cloth hangs in front of. Cloth that
/// rests on it does not hide it.
std::optional<int> body_pressed(Tools& tools, int tile, glm::vec2 at,
                                std::optional<Pins::Site> (*nearest)(Tools&, int, glm::vec2)) {
  const std::vector<Body> bodies = tools.session.simulation->bodies();
  const auto body = body_under(bodies, tools.scene.camera, at, tools.scene.viewport.size());
  if (!body) return std::nullopt;
  const std::optional<Pins::Site> site = nearest(tools, tile, at);
  if (!site) return body;
  const glm::dvec3 eye(tools.scene.camera.eye());
  const glm::dvec3 ray = tools.scene.camera.ray(at, tools.scene.viewport.size());
  const auto surface = body_surface(eye, ray, bodies[std::size_t(*body)]);
  const double particle = glm::dot(ray, cloth_in_tile(tools.scene, tile).position(site->i, site->j) - eye);
  const double resting = std::max(3 * tools.session.preset().L, 0.15 * placed(bodies[std::size_t(*body)]).extent);
  return surface && particle > *surface - resting ? body : std::nullopt;
}

void start_left(Tools& tools, glm::vec2 at) {
  Tool& tool = tools.tool;
  if (const auto body = body_pressed(tools, tool.tile, at, nearest_of_all)) {
    tool.kind = ToolKind::body;
    tool.body = *body;
    tool.body_plane = tools.session.simulation->bodies()[std::size_t(*body)].c;
    tool.body_offset = tool.body_plane -
                       tools.scene.camera.unproject_in_camera_plane(at, tool.body_plane, tools.scene.viewport.size());
  } else {
    tool.kind = ToolKind::cut;
    tool.knife_gesture = std::max(tool.knife_gesture + 1, first_knife_gesture);
    tool.path = {at};
    tool.stroke.push_back({at, tools.now, tool.tile, true});
  }
}

/// Whether a right press comes soon and near enough after a click on a particle to be the second half of a double
/// click.
bool follows_click(const Tools& tools, const PointerEvent& event, glm::vec2 at) {
  const Tool& tool = tools.tool;
  return tool.last_site && event.time - tool.last_click < tools.input.double_click_s &&
         glm::length(at - tool.last_press) <= tools.px(double_click_slack);
}

void start(Tools& tools, const PointerEvent& event) {
  Tool& tool = tools.tool;
  tool.tile = tools.scene.viewport.tile_at(event.at);
  const glm::vec2 at = event.at - tools.scene.viewport.origin(tool.tile);
  tool.button = event.button;
  tool.press = tool.at = at;
  tool.press_time = event.time;
  const bool shift = (event.mods & GLFW_MOD_SHIFT) != 0, control = (event.mods & GLFW_MOD_CONTROL) != 0;
  if (event.button == GLFW_MOUSE_BUTTON_LEFT && tool.tile == 0 && on_wind_tip(tools, at)) {
    take_wind(tools);
  } else if (event.button == GLFW_MOUSE_BUTTON_MIDDLE || (event.button == GLFW_MOUSE_BUTTON_LEFT && control)) {
    tool.kind = shift ? ToolKind::pan : ToolKind::orbit;
  } else if (event.button == GLFW_MOUSE_BUTTON_LEFT && !shift) {
    start_left(tools, at);
  } else if (event.button == GLFW_MOUSE_BUTTON_RIGHT || event.button == GLFW_MOUSE_BUTTON_LEFT) {
    // With Shift the left button is the right one, which cannot be dragged on many touchpads.
    tool.kind = ToolKind::right;
    tool.second_press = follows_click(tools, event, at);
    // A swinging cloth has carried the particle away by now: the one that was clicked first is meant.
    tool.site = tool.second_press ? tool.last_site : nearest_of_all(tools, tool.tile, at);
  }
}

void start_grab(Tools& tools) {
  Tool& tool = tools.tool;
  // The cloth may have carried away what was pressed.
  const bool free = tool.site && !cloth_in_tile(tools.scene, tool.tile).pinned(tool.site->i, tool.site->j);
  const auto site = free ? tool.site : nearest_site(tools, tool.tile, tool.press, true);
  if (!site || !apply_edit(tools.session, edit::Grab{site->i, site->j})) {
    tool.kind = ToolKind::none;
    return;
  }
  tool.kind = ToolKind::grab;
  tool.site = site;
  if (tools.session.picked != site) tools.session.picked = site, tools.session.recorded.forces.clear();
}

/// The particle that was pressed, or none: its forces are shown.
void pick(Tools& tools) {
  if (tools.session.picked != tools.tool.site && force_source(tools.session) == Source::particle)
    tools.session.recorded.forces.clear();
  tools.session.picked = tools.tool.site;
}

/// Held for longer than a click takes.
bool pressed_long(const Tools& tools, double now) {
  return now - tools.tool.press_time > tools.input.double_click_s;
}

void pick_or_pin(Tools& tools, const PointerEvent& event) {
  Tool& tool = tools.tool;
  if (tool.second_press && tool.site && !pressed_long(tools, event.time)) {
    const auto [i, j] = *tool.site;
    if (!tools.session.simulation->has(i, j)) return;  // a copy that another picture's cloth has
    apply_edit(tools.session, edit::Pin{i, j, !tools.session.simulation->pinned(i, j)});
    tool.last_site.reset();
    return;
  }
  pick(tools);
  tool.last_click = event.time;
  tool.last_press = tool.press;
  tool.last_site = pressed_long(tools, event.time) ? std::nullopt : tool.site;
}

void finish(Tools& tools, const PointerEvent& event) {
  Tool& tool = tools.tool;
  if (tool.kind == ToolKind::grab) apply_edit(tools.session, edit::Release{});
  if (tool.kind == ToolKind::right) pick_or_pin(tools, event);
  tool.kind = ToolKind::none;
}

void drag(Tools& tools, glm::vec2 at) {
  Tool& tool = tools.tool;
  const glm::vec2 moved = at - tool.at;
  tool.at = at;
  if (tool.kind == ToolKind::orbit || tool.kind == ToolKind::pan) tools.scene.camera_by_hand |= moved != glm::vec2(0);
  switch (tool.kind) {
    case ToolKind::orbit:
      tools.scene.camera.orbit(moved.x, moved.y);
      break;
    case ToolKind::pan:
      tools.scene.camera.pan(moved.x, moved.y, tools.scene.viewport.size().y);
      break;
    case ToolKind::cut:
      tool.path.push_back(at);
      tool.stroke.push_back({at, tools.now, tool.tile, false});
      break;
    case ToolKind::right:
      if (glm::length(at - tool.press) > tools.px(click_slack)) start_grab(tools);
      break;
    case ToolKind::none:
    case ToolKind::grab:
    case ToolKind::body:
    case ToolKind::wind:
      break;
  }
}

void wheel(Tools& tools, const PointerEvent& event) {
  if (!tools.scene.viewport.takes(event.at)) return;
  tools.scene.camera_by_hand = true;
  if ((event.mods & GLFW_MOD_SHIFT) != 0) {
    tools.scene.camera.pan(event.wheel.x * tools.px(32), event.wheel.y * tools.px(32), tools.scene.viewport.size().y);
  } else {
    tools.scene.camera.zoom(event.wheel.y);
  }
}

void move_body(Tools& tools) {
  Tool& tool = tools.tool;
  if (tool.body < 0 || std::size_t(tool.body) >= tools.session.preset().bodies.size()) {
    tool.kind = ToolKind::none;
    return;
  }
  const glm::dvec3 pointer =
      tools.scene.camera.unproject_in_camera_plane(tool.at, tool.body_plane, tools.scene.viewport.size());
  const glm::dvec3 to = glm::clamp(pointer + tool.body_offset, glm::dvec3(-1e3), glm::dvec3(1e3));
  tool.body_to.reset();
  if (to == tools.session.simulation->bodies()[std::size_t(tool.body)].c) return;
  if (tools.session.goes_on())
    tool.body_to = to;
  else
    apply_edit(tools.session, edit::MoveBody{tool.body, to}, unsigned(tool.body) + 1);
}

/// What a held tool does every frame, whether the pointer moved or not.
void hold(Tools& tools) {
  Tool& tool = tools.tool;
  // A finger held still reads the particle off, and takes hold of it when it moves; a mouse takes hold.
  if (tool.kind == ToolKind::right && tool.site && pressed_long(tools, tools.now))
    tools.input.by_touch ? pick(tools) : start_grab(tools);
  if (tool.kind == ToolKind::cut) use_knife(tools);
  if (tool.kind == ToolKind::body) move_body(tools);
  if (tool.kind == ToolKind::wind) drag_wind(tools);
  if (tool.kind != ToolKind::grab) return;
  const auto held = tools.session.simulation->held();
  if (!held) {
    tool.kind = ToolKind::none;
    return;
  }
  const glm::dvec3 through = cloth_in_tile(tools.scene, tool.tile).position(held->i, held->j);
  tool.hand = tools.scene.camera.unproject_in_camera_plane(tool.at, through, tools.scene.viewport.size());
}

}  // namespace

float pointer_reach(const Tools& tools) {
  return tools.px(24);
}

void handle_pointer(Tools& tools) {
  Tool& tool = tools.tool;
  // A cloth may have been rebuilt with fewer particles while one was held down.
  const Simulation& cloth = cloth_in_tile(tools.scene, tool.tile);
  for (auto* site : {&tool.site, &tool.last_site})
    if (*site && !cloth.has((*site)->i, (*site)->j)) site->reset();
  for (const PointerEvent& event : tools.input.pointer) {
    const glm::vec2 at = event.at - tools.scene.viewport.origin(tool.tile);
    switch (event.type) {
      case PointerEvent::Type::press:
        if (tool.kind == ToolKind::none && tools.scene.viewport.takes(event.at)) start(tools, event);
        break;
      case PointerEvent::Type::move:
        drag(tools, at);
        break;
      case PointerEvent::Type::release:
        if (tool.kind == ToolKind::none || event.button != tool.button) break;
        drag(tools, at);
        hold(tools);
        finish(tools, event);
        break;
      case PointerEvent::Type::wheel:
        wheel(tools, event);
        break;
    }
  }
  hold(tools);
}

std::optional<Pins::Site> particle_under_pointer(Tools& tools) {
  if (tools.tool.kind != ToolKind::none || !tools.scene.viewport.takes(tools.input.at)) return std::nullopt;
  const int tile = tools.scene.viewport.tile_at(tools.input.at);
  return site_under(tools, tile, tools.input.at - tools.scene.viewport.origin(tile));
}

bool wind_under_pointer(const Tools& tools) {
  if (tools.tool.kind != ToolKind::none || !tools.scene.viewport.takes(tools.input.at)) return false;
  return tools.scene.viewport.tile_at(tools.input.at) == 0 &&
         on_wind_tip(tools, tools.input.at - tools.scene.viewport.origin(0));
}

bool hand_in_cloth(const Tools& tools) {
  return tools.tool.kind == ToolKind::grab || tools.tool.kind == ToolKind::cut;
}

bool body_under_pointer(Tools& tools) {
  if (tools.tool.kind != ToolKind::none || !tools.scene.viewport.takes(tools.input.at)) return false;
  const int tile = tools.scene.viewport.tile_at(tools.input.at);
  return body_pressed(tools, tile, tools.input.at - tools.scene.viewport.origin(tile), site_under).has_value();
}

int finger_button(Tools& tools, glm::vec2 at) {
  if (!tools.scene.viewport.takes(at) || tools.finger_cuts) return GLFW_MOUSE_BUTTON_LEFT;
  const int tile = tools.scene.viewport.tile_at(at);
  const glm::vec2 inside = at - tools.scene.viewport.origin(tile);
  const bool wind = tile == 0 && on_wind_tip(tools, inside);
  return wind || body_pressed(tools, tile, inside, nearest_of_all) ? GLFW_MOUSE_BUTTON_LEFT : GLFW_MOUSE_BUTTON_RIGHT;
}

}  // namespace tyglab
