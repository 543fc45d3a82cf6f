#include "app/tools/knife.h"

#include <algorithm>
#include <array>

#include "app/render/picking.h"
#include "app/render/spring_picking.h"
#include "app/ui/app.h"

namespace tyglab {
namespace {

constexpr float nick = 6;  // half of the stroke that is shown before the press, pixels at scale 1

/// What the pointer's way of this frame has crossed.
void cut_along_path(App& app) {
  Tool& tool = app.tool;
  const Simulation& cloth = cloth_in_tile(app, tool.tile);
  std::vector<Stroke> strokes;
  for (std::size_t k = 1; k < tool.path.size(); ++k)
    if (tool.path[k] != tool.path[k - 1]) strokes.push_back({tool.path[k - 1], tool.path[k]});
  tool.path = {tool.at};
  if (strokes.empty()) return;
  edit::CutSprings cut{
      springs_across(cloth.positions(), cloth.tears(), app.camera, app.preset().bodies, strokes, app.viewport.size())};
  if (!cut.springs.empty()) apply_edit(app, std::move(cut));
}

/// The report's cut: the particles near the pointer's way lose their springs upwards.
void cut_upwards(App& app) {
  Tool& tool = app.tool;
  std::vector<Pins::Site> sites;
  if (tool.path.size() == 1) tool.path.push_back(tool.path.front());
  for (std::size_t k = 1; k < tool.path.size(); ++k)
    for (const Pins::Site& site :
         particles_near_path(cloth_in_tile(app, tool.tile).positions(), app.camera, tool.path[k - 1], tool.path[k],
                             app.viewport.size(), pointer_reach(app)))
      if (std::find(sites.begin(), sites.end(), site) == sites.end()) sites.push_back(site);
  tool.path = {tool.at};
  if (!sites.empty()) apply_edit(app, edit::Cut{std::move(sites)});
}

}  // namespace

void use_knife(App& app) {
  app.settings.handling.cut_along_path ? cut_along_path(app) : cut_upwards(app);
}

bool cuts_between_steps(const App& app) {
  return app.tool.kind == Tool::Kind::cut && !app.settings.handling.cut_along_path;
}

void cut_between_steps(App& app) {
  if (cuts_between_steps(app)) use_knife(app);
}

std::vector<SpringSite> springs_under_pointer(App& app) {
  const Lattice& lattice = app.simulation->lattice();
  if (app.tool.kind != Tool::Kind::none || !app.viewport.takes(app.input.at) || lattice.size() > Lockstep::largest)
    return {};
  const int tile = app.viewport.tile_at(app.input.at);
  const Simulation& cloth = cloth_in_tile(app, tile);
  const glm::vec2 at = app.input.at - app.viewport.origin(tile);
  const glm::vec2 across(app.theme.px(nick), 0), down(0, app.theme.px(nick));
  const std::array strokes{Stroke{at - across, at + across}, Stroke{at - down, at + down}};
  return springs_across(cloth.positions(), cloth.tears(), app.camera, app.preset().bodies, strokes,
                        app.viewport.size());
}

}  // namespace tyglab
