
#include "app/tools/tools.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

#include "app/base/glfw_keys.h"
#include "app/render/picking.h"
#include "app/session/session.h"

namespace tyglab {

void Tools::follow() {
  const SessionCounts& counts = session.counts;
  if (counts.documents != seen_.documents) tool = Tool{}, wind_arrow.reset();
  if (counts.hands != seen_.hands) tool.kind = Tool::Kind::none;
  if (counts.lattices != seen_.lattices) {
    tool.site.reset(), tool.last_site.reset();
    if (tool.kind == Tool::Kind::grab) tool.kind = Tool::Kind::none;
  }
  seen_ = counts;
}

SessionInput Tools::session_input() {
  SessionInput wanted;
  if (tool.kind == Tool::Kind::grab) wanted.hand = tool.hand;
  if (tool.kind == Tool::Kind::body && tool.body_to)
    wanted.body = edit::MoveBody{tool.body, *tool.body_to}, wanted.body_gesture = unsigned(tool.body) + 1;
  if (cuts_between_steps(*this)) wanted.after_steps = [this] { use_knife(*this); };
  wanted.touched = tool.kind != Tool::Kind::none;
  wanted.slow_motion = settings.slow_hand && hand_in_cloth(*this);
  return wanted;
}

namespace {

constexpr float nick = 6;  // half of the stroke that is shown before the press, pixels at scale 1

/// What the pointer's path of this frame has crossed.
void cut_along_path(Tools& tools) {
  Tool& tool = tools.tool;
  const Simulation& cloth = cloth_in_tile(tools.scene, tool.tile);
  std::vector<Stroke> strokes;
  for (std::size_t k = 1; k < tool.path.size(); ++k)
    if (tool.path[k] != tool.path[k - 1]) strokes.push_back({tool.path[k - 1], tool.path[k]});
  tool.path = {tool.at};
  if (strokes.empty()) return;
  edit::CutSprings cut{springs_across(cloth.positions(), cloth.tears(), tools.scene.camera,
                                      tools.session.simulation->bodies(), strokes, tools.scene.viewport.size())};
  if (!cut.springs.empty()) apply_edit(tools.session, std::move(cut), tool.knife_gesture);
}

/// The report's cut: the particles near the pointer's path lose their springs upward.
void cut_upwards(Tools& tools) {
  Tool& tool = tools.tool;
  std::vector<Pins::Site> sites;
  if (tool.path.size() == 1) tool.path.push_back(tool.path.front());
  for (std::size_t k = 1; k < tool.path.size(); ++k)
    for (const Pins::Site& site :
         particles_near_path(cloth_in_tile(tools.scene, tool.tile).positions(), tools.scene.camera, tool.path[k - 1],
                             tool.path[k], tools.scene.viewport.size(), pointer_reach(tools)))
      if (std::find(sites.begin(), sites.end(), site) == sites.end()) sites.push_back(site);
  tool.path = {tool.at};
  if (!sites.empty()) apply_edit(tools.session, edit::Cut{std::move(sites)}, tool.knife_gesture);
}

}  // namespace

void use_knife(Tools& tools) {
  tools.settings.cut_along_path ? cut_along_path(tools) : cut_upwards(tools);
}

bool cuts_between_steps(const Tools& tools) {
  return tools.tool.kind == Tool::Kind::cut && !tools.settings.cut_along_path;
}

std::vector<SpringSite> springs_under_pointer(Tools& tools) {
  const Lattice& lattice = tools.session.simulation->lattice();
  if (tools.tool.kind != Tool::Kind::none || !tools.scene.viewport.takes(tools.input.at) ||
      lattice.size() > Lockstep::largest)
    return {};
  const int tile = tools.scene.viewport.tile_at(tools.input.at);
  const Simulation& cloth = cloth_in_tile(tools.scene, tile);
  const glm::vec2 at = tools.input.at - tools.scene.viewport.origin(tile);
  const glm::vec2 across(tools.px(nick), 0), down(0, tools.px(nick));
  const std::array strokes{Stroke{at - across, at + across}, Stroke{at - down, at + down}};
  return springs_across(cloth.positions(), cloth.tears(), tools.scene.camera, tools.session.simulation->bodies(),
                        strokes, tools.scene.viewport.size());
}

namespace {

constexpr float usual = 80, longest = 140, handle = 14, margin = 20, calm = 8;  // pixels at scale 1
constexpr float from_right = 132, from_below = 120;
constexpr double most = 1e3;                    // N or m/s, of a component
constexpr double gentle_breeze = 3;             // m/s
constexpr unsigned first_gesture = 0x77000000;  // apart from those of sliders and bodies

/// N or m/s: what an arrow of the usual length stands for.
double unit_of(const Tools& tools) {
  const Preset& saved = tools.session.document.saved;
  const auto key = wind_of_arrow(tools);
  if (const double wind = glm::length(saved.*key); wind > 0) return wind;
  if (key == &Preset::u) return gentle_breeze;
  const double weight = std::abs(saved.m * saved.g);
  return weight > 0 ? weight : 1e-3;
}

/// The nearest axis, if Ctrl asks for one.
glm::dvec3 snapped(const glm::dvec3& wind) {
  const glm::dvec3 size = glm::abs(wind);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  glm::dvec3 on_axis(0);
  on_axis[axis] = wind[axis];
  return on_axis;
}

/// Components with that many digits as the largest needs for three.
glm::dvec3 tidy(const glm::dvec3& wind) {
  const glm::dvec3 size = glm::abs(wind);
  const double largest = std::max({size.x, size.y, size.z});
  if (!(largest > 0)) return glm::dvec3(0);
  const double digits = std::pow(10, 2 - std::floor(std::log10(largest)));
  return glm::clamp(glm::round(wind * digits) / digits, -most, most);
}

/// How far a place lies beyond the part of the first picture in which the tip can be seen and taken, px; none behind
/// the camera.
std::optional<glm::vec2> beyond(const Tools& tools, const glm::dvec3& place) {
  const glm::vec2 size = tools.scene.viewport.size(), edge = glm::min(glm::vec2(tools.px(margin)), size / 2.f);
  const auto at = tools.scene.camera.project(place, size);
  if (!at) return std::nullopt;
  return *at - glm::clamp(*at, edge, size - edge);
}

/// An arrow from that pixel, as long as the wind asks for.
WindArrow arrow_from(const Tools& tools, glm::vec2 foot, const glm::dvec3& wind) {
  const glm::vec2 size = tools.scene.viewport.size();
  const glm::dvec3 base =
      tools.scene.camera.unproject_in_camera_plane(foot, glm::dvec3(tools.scene.camera.target), size);
  const double per_pixel = tools.scene.camera.metres_per_pixel(base, size.y);
  const double per_unit = tools.px(usual) * per_pixel / unit_of(tools);
  const double length = glm::length(wind) * per_unit, room = tools.px(longest) * per_pixel;
  return {base, base + wind * per_unit * (length > room ? room / length : 1), per_unit};
}

/// Where the arrow begins: near the lower right corner, moved by as much as the tip would lie outside. While its tip is
/// dragged it stays.
glm::vec2 foot_of(const Tools& tools) {
  if (tools.tool.kind == Tool::Kind::wind) return tools.tool.wind_foot;
  const glm::vec2 size = tools.scene.viewport.size(), away{tools.px(from_right), tools.px(from_below)};
  const glm::vec2 edge = glm::min(glm::vec2(tools.px(margin)), size / 2.f);
  glm::vec2 foot = glm::max(size - away, size / 2.f);
  for (int n = 0; n < 3; ++n)  // in perspective the arrow's length changes a little as it moves
    if (const auto over = beyond(tools, arrow_from(tools, foot, requested_wind(tools)).tip))
      foot = glm::clamp(foot - *over, edge, size - edge);
  return foot;
}

}  // namespace

glm::dvec3 Preset::*wind_of_arrow(const Tools& tools) {
  if (tools.tool.kind == Tool::Kind::wind) return tools.tool.wind_key;
  const Preset& preset = tools.session.requested_preset();
  return preset.air_density > 0 && preset.W == glm::dvec3(0) ? &Preset::u : &Preset::W;
}

glm::dvec3 requested_wind(const Tools& tools) {
  return tools.session.requested_preset().*wind_of_arrow(tools);
}

bool wind_arrow_shown(const Tools& tools) {
  return tools.session.preset().kind == Kind::cloth &&
         tools.wind_arrow.value_or(requested_wind(tools) != glm::dvec3(0));
}

WindArrow wind_arrow(const Tools& tools, const glm::dvec3& wind) {
  WindArrow arrow = arrow_from(tools, foot_of(tools), wind);
  const auto seen = [&](double part) {
    const auto over = beyond(tools, glm::mix(arrow.base, arrow.tip, part));
    return over && glm::length(*over) < 1;
  };
  if (seen(1)) return arrow;
  double least = 0, most = 1;  // of its length
  for (int n = 0; n < 20; ++n) (seen((least + most) / 2) ? least : most) = (least + most) / 2;
  arrow.tip = glm::mix(arrow.base, arrow.tip, least);
  return arrow;
}

bool on_wind_tip(const Tools& tools, glm::vec2 at) {
  if (!wind_arrow_shown(tools)) return false;
  const auto tip =
      tools.scene.camera.project(wind_arrow(tools, requested_wind(tools)).tip, tools.scene.viewport.size());
  return tip && glm::distance(*tip, at) <= tools.px(handle);
}

void take_wind(Tools& tools) {
  Tool& tool = tools.tool;
  tool.wind_foot = foot_of(tools);
  tool.wind_key = wind_of_arrow(tools);
  tool.kind = Tool::Kind::wind;
  tool.wind = requested_wind(tools);
  tool.wind_gesture = std::max(tool.wind_gesture + 1, first_gesture);
  tools.wind_arrow = true;  // a wind that is dragged to nothing can be taken up again
}

void drag_wind(Tools& tools) {
  const Tool& tool = tools.tool;
  const WindArrow arrow = wind_arrow(tools, tool.wind);
  const glm::vec2 size = tools.scene.viewport.size();
  glm::dvec3 way = tools.scene.camera.unproject_in_camera_plane(tool.at, arrow.tip, size) -
                   tools.scene.camera.unproject_in_camera_plane(tool.press, arrow.tip, size);
  const double per_pixel = tools.scene.camera.metres_per_pixel(arrow.base, size.y);
  if ((tools.input.mods & GLFW_MOD_SHIFT) != 0)
    way = double(tool.press.y - tool.at.y) * per_pixel * glm::dvec3(tools.scene.camera.forward());
  glm::dvec3 wind = tool.wind + way / arrow.metres_per_unit;
  if ((tools.input.mods & GLFW_MOD_CONTROL) != 0) wind = snapped(wind);
  if (glm::length(wind) * arrow.metres_per_unit < tools.px(calm) * per_pixel) wind = glm::dvec3(0);
  Preset next = tools.session.requested_preset();
  next.*tool.wind_key = tool.at == tool.press ? tool.wind : tidy(wind);
  if (next.*tool.wind_key != requested_wind(tools)) tools.session.propose(std::move(next), tool.wind_gesture);
}

}  // namespace tyglab
