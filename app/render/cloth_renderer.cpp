#include "app/render/cloth_renderer.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "app/platform/gl/dialect.h"
#include "app/render/cloth_renderer_parts.h"
#include "core/engines/vertex_sharing.h"

namespace tyglab {
namespace {

/// shaders/frame.glsl, in std140.
struct FrameBlock {
  glm::mat4 clip_from_world, shadow_from_world;
  glm::vec4 eye, to_light, viewport, focus, background_top, background_bottom, grid;
};

std::function<bool(int, int)> pins_of(const Simulation& simulation) {
  return [&simulation](int i, int j) { return simulation.pinned(i, j); };
}

/// Why something had to be copied to be drawn: a part of a sentence.
std::string why_copied(const Engine& engine, const ClothMesh& mesh, const ViewOptions& options) {
  const VertexSharing* sharing = engine.vertex_sharing();
  if (sharing == nullptr) return "the CPU engine keeps positions in main memory";
  if (std::string why = sharing->copy_reason(); !why.empty()) return why;
  if (std::string why = mesh.problem(); !why.empty()) return why;
  if (options.every > 1) return "the cloth is finer than the picture, so only some particles are drawn";
  if (options.longest_edge > 0) return "the edges of a diverged cloth are measured before they are drawn";
  return "it was drawn before it moved to the engine's device";
}

}  // namespace

ClothRenderer::ClothRenderer() : parts_(std::make_unique<Parts>(std::make_shared<Shared>())) {}
ClothRenderer::ClothRenderer(const ClothRenderer& sibling) : parts_(std::make_unique<Parts>(sibling.parts_->shared)) {}
ClothRenderer::~ClothRenderer() = default;

std::optional<std::string> ClothRenderer::set_texture(const std::filesystem::path& file) {
  try {
    return set_texture(read_picture(file));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

std::optional<std::string> ClothRenderer::set_texture(const ClothPicture& picture) {
  try {
    parts_->shared->texture.take(picture);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return std::nullopt;
}

void ClothRenderer::lend_memory(Simulation& simulation) {
  parts_->mesh.lend(simulation.engine());
}

void ClothRenderer::update(Simulation& simulation, const ViewOptions& options) {
  Parts& p = *parts_;
  // Another simulation may stand where the last one stood, with the same count of changes.
  const bool other = p.simulation != &simulation || !(p.preset == simulation.preset());
  const bool moved = other || p.revision != simulation.revision();
  const bool topology_changed = other || p.tear_revision != simulation.tear_revision();
  p.simulation = &simulation;
  p.revision = simulation.revision();
  p.tear_revision = simulation.tear_revision();
  const auto copied_since_last = [&] {  // another engine counts again
    const std::uint64_t before = std::exchange(p.engine_copied, bytes_read(simulation.engine()));
    return std::size_t(p.engine_copied - std::min(p.engine_copied, before));
  };
  if (other) p.engine_copied = bytes_read(simulation.engine());  // what it was made from is nobody's read-out
  p.work.read += copied_since_last();
  if (!p.take_written(simulation, options, moved, topology_changed))
    p.take_read(simulation, options, moved, topology_changed);
  p.work.copied += copied_since_last();
  p.work.why_copied = p.work.copied > 0 ? why_copied(simulation.engine(), p.mesh, options) : "";
}

void ClothRenderer::update(const ClothScene& scene, const ViewOptions& options, bool topology_changed) {
  parts_->simulation = nullptr;
  parts_->take(scene, options, true, topology_changed);
}

/// Has the simulation's device write what is drawn; false where it cannot.
bool ClothRenderer::Parts::take_written(Simulation& cloth, const ViewOptions& options, bool moved,
                                        bool topology_changed) {
  // Which edges are too long must be looked at here; a diverged cloth stands still, so its copy is made once.
  if (options.longest_edge > 0 || !mesh.can_be_written(cloth.engine())) return false;
  const DrawnSites sites{cloth.lattice(), options.every};
  const PositionView sizes{sites.rows(), sites.columns(), 3 * sites.columns()};
  try {
    take({sizes, cloth.lattice(), cloth.tears(), cloth.posed(), pins_of(cloth), VertexWriter{&cloth.engine(), sites}},
         options, moved || !written, topology_changed);
  } catch (const EngineError& error) {
    mesh.copy_from_now_on(std::string("no buffer could be shared: ") + error.what());
    written = true;  // whatever has been written: all is to be copied now
    return false;
  }
  return written = true;
}

/// Takes positions from the simulation's memory.
void ClothRenderer::Parts::take_read(Simulation& cloth, const ViewOptions& options, bool moved, bool topology_changed) {
  take({drawn_positions(cloth.engine()), cloth.lattice(), cloth.tears(), cloth.posed(), pins_of(cloth), {}}, options,
       moved || written, topology_changed);
  written = false;
}

void ClothRenderer::Parts::take(const ClothScene& scene, const ViewOptions& options, bool moved,
                                bool topology_changed) {
  every = options.every;
  if (every > 1) {
    drawn.take(scene, every, moved, topology_changed);
    if (moved && !scene.writer) work.copied += drawn.bytes();
    mesh.update(drawn.scene(scene), options, moved, topology_changed, work);
  } else {
    mesh.update(scene, options, moved, topology_changed, work);
  }
  if (!moved) return;
  shadow_stale = true;
  if (!(preset == scene.preset) || framed.empty()) take_preset(scene.preset);
  box = mesh.bounds();
  if (one_weight()) {
    weight_model = tyglab::weight_model(preset, scene.positions.at(0, 0));
    spring.upload(weight_model.spring);
    hanger.upload(weight_model.hanger);
    rest_line.upload(weight_model.rest);
    equilibrium_line.upload(weight_model.equilibrium);
    box = framed;
    box.add(weight_model.weight);
  }
  for (const Body& body : preset.bodies)
    if (const auto of_body = body_bounds(body, framed)) box.add(of_body->lo), box.add(of_body->hi);
}

void ClothRenderer::Parts::take_preset(const Preset& next) {
  preset = next;
  framed = scene_bounds(preset);
  ground_y = float(ground_height(preset));
  has_plane = floor_height(preset).has_value();
  // Cloth that lies on a plane would flicker with the ground at the very same height.
  ground_y -= 0.004f * glm::length(framed.hi - framed.lo);
}

void ClothRenderer::Parts::fill_frame(const Camera& camera, const ViewOptions& options, int width, int height) {
  const glm::vec3 center = (framed.lo + framed.hi) / 2.0f;
  const float radius = scene_radius();
  const glm::vec3 extent = box.empty() ? glm::vec3(1) : box.hi - box.lo;
  FrameBlock block;
  const glm::mat4 projection = camera.projection(float(width) / float(height));
  block.clip_from_world = projection * camera.view();
  block.shadow_from_world = ShadowMap::fit(box.empty() ? framed : box, to_light);
  block.eye = glm::vec4(camera.eye(), 0.5f * float(height) * projection[1][1]);
  block.to_light = glm::vec4(to_light, !options.shadows ? 0 : options.soft_shadows ? 1 : 2);
  block.viewport = glm::vec4(width, height, glm::length(extent) / ShadowMap::size, ground_y);
  block.focus = glm::vec4(center, radius);
  block.background_top = glm::vec4(options.palette.background_top, 1);
  block.background_bottom = glm::vec4(options.palette.background_bottom, 1);
  block.grid = glm::vec4(options.palette.grid, grid_spacing(radius));
  shared->frame.write(GL_UNIFORM_BUFFER, &block, sizeof block);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, shared->frame.id());
}

void ClothRenderer::set_values(std::span<const float> values, int rows, int columns) {
  const Stopwatch watch(parts_->work.upload);
  parts_->values.take(values, rows, columns);
}

void ClothRenderer::set_color_map(std::span<const std::uint32_t> colors) {
  Shared& shared = *parts_->shared;
  if (!shared.colored) shared.colored.emplace();
  shared.colored->map.take(colors);
}

void ClothRenderer::draw(const Camera& camera, const ViewOptions& options, int width, int height,
                         std::span<const Ghost> ghosts) {
  Parts& p = *parts_;
  const SavedTarget saved;
  for (const GLenum off : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST}) glDisable(off);
  glEnable(GL_DEPTH_TEST);
  enable_smooth_edges_and_point_sizes();
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glBlendEquation(GL_FUNC_ADD);

  p.timer.begin();
  p.fill_frame(camera, options, width, height);
  p.draw_shadow(options);
  p.target.begin(width, height, options.samples);
  glClear(GL_DEPTH_BUFFER_BIT);
  p.shared->texture.bind(Parts::texture_unit);
  p.shadow.bind(Parts::shadow_unit);
  if (options.colored && p.shared->colored)
    p.values.bind(Parts::values_unit), p.shared->colored->map.bind(Parts::colors_unit);
  p.draw_opaque(options);
  p.draw_background();
  if (options.ground) p.has_plane ? p.draw_plane(camera, options) : p.draw_grid();
  if (!p.one_weight()) p.draw_blended(options);
  for (const Ghost& ghost : ghosts) p.draw_ghost(*ghost.cloth->parts_, ghost.color, options.line_width);
  p.target.resolve();
  p.timer.end();
  p.mesh.drawn();
  for (const Ghost& ghost : ghosts) ghost.cloth->parts_->mesh.drawn();

  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, 0);
  glDisable(GL_DEPTH_TEST);
}

unsigned ClothRenderer::texture_id() const {
  return parts_->target.texture();
}
double ClothRenderer::drawn_ms() {
  return parts_->timer.ms();
}
const Bounds& ClothRenderer::bounds() const {
  return parts_->mesh.bounds();
}
RenderWork ClothRenderer::take_work() {
  return std::exchange(parts_->work, {});
}
std::size_t ClothRenderer::bytes() const {
  return parts_->mesh.bytes() + parts_->drawn.bytes() + parts_->values.bytes() + parts_->shared->loans->bytes();
}
Image ClothRenderer::pixels() const {
  return parts_->target.pixels();
}

}  // namespace tyglab
