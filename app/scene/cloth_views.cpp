#include "app/scene/cloth_views.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/render/cloth_renderer.h"
#include "app/scene/scene.h"

namespace tyglab {
namespace {

constexpr double calm_stretch = 5;     // rest lengths; what is longer is not drawn of a diverged cloth
constexpr float most_covered = 0.46f;  // of a picture's height by buttons, as far as framing makes room for them
constexpr int outlines = 4;            // the view that ghosts are drawn in
constexpr int ghost_lines = 10;        // along a side: a coarse net lets the cloth be seen through it

/// How a cloth of the window is drawn.
ViewOptions view_of(const Scene& scene, const Simulation& cloth, glm::ivec2 size) {
  ViewOptions view = scene.view;
  view.mode = scene.session.preset().mode;
  scene.effects.apply(view);
  view.line_width = scene.scale * 1.6f;
  view.point_size = scene.scale * 9;
  view.longest_edge = float(longest_drawn_edge(cloth));
  view.every = drawn_every(cloth.lattice().sites(), size.x, size.y);
  return view;
}

void count(FrameCosts& costs, const RenderWork& work) {
  costs.add(Part::normals, work.normals);
  costs.add(Part::upload, work.upload);
  costs.add(Part::index_lists, work.index_lists);
  costs.add(Part::shadow, work.shadow);
  if (work.moved) costs.add_copied(work.vertex_path, work.copied, work.why_copied, work.read);
}

}  // namespace

double longest_drawn_edge(const Simulation& cloth) {
  return cloth.divergence() ? calm_stretch * cloth.preset().L : 0;
}

ClothRenderer& ClothViews::renderer(Scene& scene, int tile) {
  if (tile == 0) return *scene.renderer;
  while (copies_.size() < std::size_t(tile)) copies_.push_back(std::make_unique<ClothRenderer>(*scene.renderer));
  return *copies_[std::size_t(tile - 1)];
}

unsigned ClothViews::picture(const Scene& scene, int tile) const {
  if (scene.renderer == nullptr) return 0;
  if (tile == 0) return scene.renderer->texture_id();
  return std::size_t(tile) <= copies_.size() ? copies_[std::size_t(tile - 1)]->texture_id() : 0;
}

/// Uploads the copies that are drawn over the original. Whether anything of them has changed.
bool ClothViews::take_ghosts(Scene& scene, glm::ivec2 size) {
  std::vector<Ghost> ghosts;
  std::vector<std::uint64_t> revisions;
  if (scene.session.copies.overlaid)
    for (int n = 0; n < int(scene.session.copies.lockstep.size()); ++n) {
      Simulation& cloth = cloth_of(scene.session, n);
      if (cloth.divergence()) continue;
      ViewOptions view = view_of(scene, cloth, size);
      view.mode = outlines;
      view.every = std::max(view.every, std::max(cloth.lattice().sites().rows, cloth.lattice().columns) / ghost_lines);
      ClothRenderer& its = renderer(scene, n + 1);
      its.update(cloth, view);
      count(scene.session.costs, its.take_work());
      ghosts.push_back({&its, scene.ghost_colors[std::size_t(n)]});
      revisions.push_back(cloth.revision());
    }
  const bool moved = revisions != ghost_revisions_ || ghosts.size() != ghosts_.size();
  ghosts_ = std::move(ghosts), ghost_revisions_ = std::move(revisions);
  return moved;
}

double ClothViews::draw_picture(Scene& scene, int tile, glm::ivec2 size, bool ghosts_moved) {
  Simulation& cloth = cloth_in_tile(scene, tile);
  Drawn now{&cloth, cloth.revision(), scene.camera, view_of(scene, cloth, size), size};
  const FieldColors* colors = shown_colors(scene);
  if (colors != nullptr) now.values = scene.colors.version(tile);
  if (now.values > 0) now.view.colored = colors->range();
  if (now == drawn_[std::size_t(tile)] && !scene.redraw && !ghosts_moved) return 0;
  ClothRenderer& its = renderer(scene, tile);
  if (tile > 0 || !scene.session.rebuild.holds_present()) its.lend_memory(cloth);
  its.update(cloth, now.view);
  if (now.view.colored) scene.colors.give(scene, tile, its);
  Duration took;
  {
    const Stopwatch watch(took);
    its.draw(scene.camera, now.view, size.x, size.y, ghosts_);
  }
  scene.session.costs.add(Part::draw_cloth, took);
  count(scene.session.costs, its.take_work());
  drawn_[std::size_t(tile)] = now;
  // A driver that draws in software makes the program wait; others tell some frames later.
  return std::max(1e3 * took.wall_s, its.drawn_ms());
}

std::optional<glm::vec2> ClothViews::way_to_cloth(const Scene& scene, int tile) const {
  constexpr float a_trace = 0.03f;  // of the box, whose corners reach beyond the cloth
  const Simulation& cloth = cloth_in_tile(scene, tile);
  const glm::vec2 shown = scene.viewport.size();
  if (cloth.divergence() || shown.x <= 1 || shown.y <= 1) return std::nullopt;
  const ClothRenderer* its = tile == 0                             ? scene.renderer.get()
                             : std::size_t(tile) <= copies_.size() ? copies_[std::size_t(tile - 1)].get()
                                                                   : nullptr;
  const Bounds box = its != nullptr ? its->bounds() : bounds(cloth.positions());
  if (box.empty()) return std::nullopt;
  const auto part = part_of_picture(scene.camera, box, shown.x / shown.y);
  if (part && part->in_sight() > a_trace) return std::nullopt;
  const glm::vec3 from = (box.lo + box.hi) / 2.f - scene.camera.eye();
  const glm::vec2 behind(glm::dot(from, scene.camera.right()), -glm::dot(from, scene.camera.up()));
  const glm::vec2 way = part ? ((part->lo + part->hi) / 2.f - 0.5f) * shown : behind;
  return glm::length(way) > 0 ? way : glm::vec2(0, 1);
}

void ClothViews::frame_cloths(Scene& scene, glm::vec2 shown) {
  constexpr float most_below = 0.2f;
  const glm::vec4 now(shown, scene.viewport.buttons, scene.viewport.foot);
  const bool due = scene.wants_framing || (!scene.camera_by_hand && now != framed_);
  if (!due || shown.x <= 1 || shown.y <= 1) return;
  // At the start of a scene its camera also knows where the cloth will go. Another thread may be reading the cloth.
  const bool away = scene.wants_framing ? scene.session.simulation->time() > 0 : framed_away_;
  Bounds cloths;
  if (away && !scene.session.rebuild.holds_present())
    for (int tile = 0; tile < scene.session.copies.tiles(); ++tile)
      if (const Simulation& cloth = cloth_in_tile(scene, tile); !cloth.divergence())
        cloths.add(bounds(cloth.positions()));
  const Preset& preset = scene.session.preset();
  const float aspect = shown.x / shown.y, above = std::min(now.z / shown.y, most_covered),
              below = std::min(now.w / shown.y, most_below);
  scene.camera = present_camera(preset, cloths, aspect, above, below, scene.viewport.filled);
  framed_away_ = !(scene.camera == scene_camera(preset, aspect, above, below, scene.viewport.filled));
  scene.wants_framing = scene.camera_by_hand = false;
  framed_ = now;
}

void ClothViews::draw(Scene& scene, glm::vec2 magnified) {
  const glm::vec2 shown = scene.viewport.size();
  if (shown.x < 1) return;  // the layout has not been made yet
  const glm::ivec2 size = glm::max(glm::ivec2(glm::round(shown * magnified)), glm::ivec2(1));
  frame_cloths(scene, shown);
  const int tiles = scene.session.copies.tiles();
  drawn_.resize(std::size_t(tiles));
  copies_.resize(std::min(copies_.size(), scene.session.copies.lockstep.size()));
  if (shown_colors(scene) != nullptr)
    for (int tile = 0; tile < tiles; ++tile)
      scene.colors.update(scene, tile, drawn_every(cloth_in_tile(scene, tile).lattice().sites(), size.x, size.y));
  if (scene.renderer == nullptr) return;
  const bool ghosts_moved = take_ghosts(scene, size);
  if (size != size_) scene.effects.disturb();
  size_ = size;
  double took = 0;
  for (int tile = 0; tile < tiles; ++tile) took += draw_picture(scene, tile, size, ghosts_moved);
  if (took > 0) scene.effects.drew(took);
  scene.redraw = false;
}

}  // namespace tyglab
