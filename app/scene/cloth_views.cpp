#include "app/scene/cloth_views.h"

#include <algorithm>
#include <glm/common.hpp>

#include "app/render/drawn_cloth.h"
#include "app/ui/app.h"

namespace tyglab {
namespace {

constexpr double calm_stretch = 5;    // rest lengths; what is longer is not drawn of a diverged cloth
constexpr float most_covered = 0.3f;  // of a picture's height by buttons, as far as framing makes room for them
constexpr int outlines = 4;           // the view that ghosts are drawn in
constexpr int ghost_lines = 10;       // along a side: a coarse net lets the cloth be seen through it

glm::vec3 rgb(ImU32 color) {
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(color);
  return {c.x, c.y, c.z};
}

/// How a cloth of the window is drawn.
ViewOptions view_of(const App& app, const Simulation& cloth, glm::ivec2 size) {
  ViewOptions view = app.view;
  view.mode = app.preset().mode;
  app.effects.apply(view);
  view.line_width = app.theme.scale * 1.6f;
  view.point_size = app.theme.scale * 9;
  view.longest_edge = cloth.divergence() ? float(calm_stretch * cloth.preset().L) : 0.f;
  view.every = drawn_every(cloth.lattice(), size.x, size.y);
  return view;
}

void count(FrameCosts& costs, const RenderWork& work) {
  costs.add(Part::normals, work.normals);
  costs.add(Part::upload, work.upload);
  costs.add(Part::index_lists, work.index_lists);
  costs.add(Part::shadow, work.shadow);
  if (work.moved) costs.add_copied(work.way, work.copied, work.why_copied, work.read);
}

}  // namespace

ClothRenderer& ClothViews::renderer(App& app, int tile) {
  if (tile == 0) return *app.renderer;
  while (copies_.size() < std::size_t(tile)) copies_.push_back(std::make_unique<ClothRenderer>(*app.renderer));
  return *copies_[std::size_t(tile - 1)];
}

unsigned ClothViews::picture(const App& app, int tile) const {
  if (tile == 0) return app.renderer->texture_id();
  return std::size_t(tile) <= copies_.size() ? copies_[std::size_t(tile - 1)]->texture_id() : 0;
}

/// Uploads the copies that are drawn over the original. Whether anything of them has changed.
bool ClothViews::take_ghosts(App& app, glm::ivec2 size) {
  std::vector<Ghost> ghosts;
  std::vector<std::uint64_t> revisions;
  if (app.copies.overlaid)
    for (int n = 0; n < int(app.copies.lockstep.size()); ++n) {
      Simulation& cloth = cloth_of(app, n);
      if (cloth.divergence()) continue;
      ViewOptions view = view_of(app, cloth, size);
      view.mode = outlines;
      view.every = std::max(view.every, std::max(cloth.lattice().rows, cloth.lattice().columns) / ghost_lines);
      ClothRenderer& its = renderer(app, n + 1);
      its.update(cloth, view);
      count(app.costs, its.take_work());
      ghosts.push_back({&its, rgb(style_of_cloth(app, n).color)});
      revisions.push_back(cloth.revision());
    }
  const bool moved = revisions != ghost_revisions_ || ghosts.size() != ghosts_.size();
  ghosts_ = std::move(ghosts), ghost_revisions_ = std::move(revisions);
  return moved;
}

double ClothViews::draw_picture(App& app, int tile, glm::ivec2 size, bool ghosts_moved) {
  Simulation& cloth = cloth_in_tile(app, tile);
  Drawn now{&cloth, cloth.revision(), app.camera, view_of(app, cloth, size), size};
  const FieldColors* colors = shown_colors(app);
  if (colors != nullptr) now.values = app.colors.version(tile);
  if (now.values > 0) now.view.colored = colors->range();
  if (now == drawn_[std::size_t(tile)] && !app.redraw_cloth && !ghosts_moved) return 0;
  ClothRenderer& its = renderer(app, tile);
  if (tile > 0 || !app.building.holds_present()) its.lend_memory(cloth);
  its.update(cloth, now.view);
  if (now.view.colored) app.colors.give(app, tile, its);
  Duration took;
  {
    const Stopwatch watch(took);
    its.draw(app.camera, now.view, size.x, size.y, ghosts_);
  }
  app.costs.add(Part::draw_cloth, took);
  count(app.costs, its.take_work());
  drawn_[std::size_t(tile)] = now;
  // A driver that draws in software makes the program wait; others tell some frames later.
  return std::max(1e3 * took.wall_s, its.drawn_ms());
}

void ClothViews::frame_scene(App& app, glm::vec2 shown) {
  const glm::vec3 now(shown, app.viewport.buttons);
  const bool due = app.wants_framing || (!app.camera_by_hand && now != framed_);
  if (!due || shown.x <= 1 || shown.y <= 1) return;
  app.camera = scene_camera(app.preset(), shown.x / shown.y, std::min(now.z / shown.y, most_covered));
  app.wants_framing = app.camera_by_hand = false;
  framed_ = now;
}

void ClothViews::draw(App& app, glm::vec2 magnified) {
  const glm::vec2 shown = app.viewport.size();
  if (shown.x < 1) return;  // the layout has not been made yet
  const glm::ivec2 size = glm::max(glm::ivec2(glm::round(shown * magnified)), glm::ivec2(1));
  frame_scene(app, shown);
  const int tiles = app.copies.tiles();
  drawn_.resize(std::size_t(tiles));
  copies_.resize(std::min(copies_.size(), app.copies.lockstep.size()));
  const bool ghosts_moved = take_ghosts(app, size);
  if (shown_colors(app) != nullptr)
    for (int tile = 0; tile < tiles; ++tile)
      app.colors.update(app, tile, drawn_every(cloth_in_tile(app, tile).lattice(), size.x, size.y));
  if (size != size_) app.effects.disturb();
  size_ = size;
  double took = 0;
  for (int tile = 0; tile < tiles; ++tile) took += draw_picture(app, tile, size, ghosts_moved);
  if (took > 0) app.effects.drew(took);
  app.redraw_cloth = false;
}

}  // namespace tyglab
