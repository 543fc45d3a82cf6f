#include "app/tools/knife.h"

#include <algorithm>
#include <array>

#include "app/render/picking.h"
#include "app/render/spring_picking.h"
#include "app/session/edits.h"
#include "app/tools/tools.h"

namespace tyglab {
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
                                      tools.session.preset().bodies, strokes, tools.scene.viewport.size())};
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
  return springs_across(cloth.positions(), cloth.tears(), tools.scene.camera, tools.session.preset().bodies, strokes,
                        tools.scene.viewport.size());
}

}  // namespace tyglab
