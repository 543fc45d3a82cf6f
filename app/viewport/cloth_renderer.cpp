#include "app/viewport/cloth_renderer.h"

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <utility>

#include "app/viewport/cloth_mesh.h"
#include "app/viewport/cloth_texture.h"
#include "app/viewport/draw_timer.h"
#include "app/viewport/drawn_cloth.h"
#include "app/viewport/gl_objects.h"
#include "app/viewport/render_target.h"
#include "app/viewport/shadow_map.h"
#include "app/viewport/solid_mesh.h"
#include "app/viewport/staging.h"
#include "app/viewport/value_texture.h"
#include "app/viewport/weight_model.h"

namespace tyglab {
namespace {

const glm::vec3 to_light = glm::normalize(glm::vec3(-0.66f, 0.86f, 0.60f));
constexpr int texture_unit = 0, shadow_unit = 1, values_unit = 2, colors_unit = 3;
constexpr float ghost_opacity = 0.9f;
constexpr float hem_part = 0.007f;  ///< of the cloth's shorter side

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
  if (std::string why = engine.why_copied(); !why.empty()) return why;
  if (std::string why = mesh.problem(); !why.empty()) return why;
  if (options.every > 1) return "the cloth is finer than the picture, so that not all of it is drawn";
  if (options.longest_edge > 0) return "the edges of a diverged cloth are measured before they are drawn";
  return "it was drawn before it came to the engine's device";
}

}  // namespace

/// What cloths of one window share.
struct ClothRenderer::Shared {
  /// What only a cloth needs that is coloured by values.
  struct Colored {
    gl::Program cloth{{"cloth.vert", "cloth.frag", {}, "COLORED"}};
    gl::Program lines{{"lines.vert", "lines.frag", "lines.geom", "COLORED"}};
    gl::Program points{{"points.vert", "points.frag", {}, "COLORED"}};
    ValueTexture map{GL_LINEAR};
  };

  gl::Program background{{"background.vert", "background.frag"}};
  gl::Program ground{{"ground.vert", "ground.frag"}};
  gl::Program ground_shadow{{"ground.vert", "ground_shadow.frag"}};
  gl::Program cloth{{"cloth.vert", "cloth.frag"}};
  gl::Program solid{{"solid.vert", "solid.frag"}};
  gl::Program lines{{"lines.vert", "lines.frag", "lines.geom"}};
  gl::Program points{{"points.vert", "points.frag"}};
  gl::Program cloth_depth{{"cloth_depth.vert", "depth.frag"}};
  gl::Program solid_depth{{"solid_depth.vert", "depth.frag"}};
  gl::Buffer frame;
  gl::VertexArray nothing;  ///< core profile draws with an array bound, even an empty one
  ClothTexture texture;
  SolidMesh sphere{sphere_geometry(64, 40)};
  std::optional<Colored> colored;  ///< made when they are first asked for
  std::shared_ptr<PositionLoans> loans = std::make_shared<PositionLoans>();
};

struct ClothRenderer::Parts {
  std::shared_ptr<Shared> shared;
  ClothMesh mesh{shared->loans};
  DrawnCloth drawn;  ///< where not every particle is
  int every = 1;
  SolidMesh spring, hanger, rest_line, equilibrium_line;
  WeightModel weight_model;
  ShadowMap shadow;
  RenderTarget target;
  ValueTexture values{GL_NEAREST};
  DrawTimer timer;

  Preset preset;
  Bounds box;     ///< of all that casts shadows
  Bounds framed;  ///< scene_bounds of the preset, kept as long as it
  float ground_y = 0;
  bool shadow_stale = true;
  bool shadow_of_cloth = false;  ///< whether the cloth is in the shadow map: a net casts none
  RenderWork work;
  // What update() saw last.
  const Simulation* simulation = nullptr;
  std::uint64_t revision = 0, tear_revision = 0;
  std::uint64_t engine_copied = 0;
  bool written = false;  ///< the last time the device wrote what is drawn

  explicit Parts(std::shared_ptr<Shared> with) : shared(std::move(with)) {}
  bool take_written(Simulation& cloth, const ViewOptions& options, bool moved, bool topology_changed);
  void take_read(Simulation& cloth, const ViewOptions& options, bool moved, bool topology_changed);
  void take(const ClothScene& scene, const ViewOptions& options, bool moved, bool topology_changed);
  void take_preset(const Preset& next);
  void fill_frame(const Camera& camera, const ViewOptions& options, int width, int height);
  void draw_shadow(const ViewOptions& options);
  void draw_background();
  void draw_ground(const ViewOptions& options);
  void draw_solid(const SolidMesh& mesh, glm::vec4 placed, glm::vec3 base, float gloss);
  void draw_bodies(const ViewOptions& options);
  void draw_weight(const ViewOptions& options);
  void draw_triangles(const ViewOptions& options);
  const gl::Program& use(const gl::Program& plain, const gl::Program* colored, const ViewOptions& options);
  void draw_lines(ClothMesh::List list, const ViewOptions& options, float opacity, float width);
  void draw_bending(const ViewOptions& options);
  void draw_points(const ViewOptions& options);
  void draw_marks(const ViewOptions& options);
  void draw_ghost(const Parts& other, glm::vec3 colour, float width);
  void draw_opaque(const ViewOptions& options);
  void draw_blended(const ViewOptions& options);
  float scene_radius() const { return std::max(glm::length(framed.hi - framed.lo) / 2, 1e-4f); }
  float spacing() const { return float(preset.L * every); }
  bool one_weight() const { return preset.kind == Kind::one_weight; }
};

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
  const auto copied_since_last = [&] {  // another engine counts anew
    const std::uint64_t before = std::exchange(p.engine_copied, simulation.engine().copied());
    return std::size_t(p.engine_copied - std::min(p.engine_copied, before));
  };
  if (other) p.engine_copied = simulation.engine().copied();  // what it was made from is nobody's read-out
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
    take({sizes, cloth.lattice(), cloth.tears(), cloth.preset(), pins_of(cloth), VertexWriter{&cloth.engine(), sites}},
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
  take({cloth.engine().shown(), cloth.lattice(), cloth.tears(), cloth.preset(), pins_of(cloth), {}}, options,
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
  for (const Body& body : preset.bodies) {
    if (body.shape != Body::Shape::sphere) continue;
    box.add(glm::vec3(body.c) - float(body.r));
    box.add(glm::vec3(body.c) + float(body.r));
  }
}

void ClothRenderer::Parts::take_preset(const Preset& next) {
  preset = next;
  framed = scene_bounds(preset);
  ground_y = float(ground_height(preset));
  // Cloth that lies on a plane would flicker with the ground at the very same height.
  ground_y -= 0.004f * glm::length(framed.hi - framed.lo);
}

void ClothRenderer::Parts::fill_frame(const Camera& camera, const ViewOptions& options, int width, int height) {
  const glm::vec3 centre = (framed.lo + framed.hi) / 2.0f;
  const float radius = scene_radius();
  const glm::vec3 extent = box.empty() ? glm::vec3(1) : box.hi - box.lo;
  FrameBlock block;
  const glm::mat4 projection = camera.projection(float(width) / float(height));
  block.clip_from_world = projection * camera.view();
  block.shadow_from_world = ShadowMap::fit(box.empty() ? framed : box, to_light);
  block.eye = glm::vec4(camera.eye(), 0.5f * float(height) * projection[1][1]);
  block.to_light = glm::vec4(to_light, !options.shadows ? 0 : options.soft_shadows ? 1 : 2);
  block.viewport = glm::vec4(width, height, glm::length(extent) / ShadowMap::size, ground_y);
  block.focus = glm::vec4(centre, radius);
  block.background_top = glm::vec4(options.palette.background_top, 1);
  block.background_bottom = glm::vec4(options.palette.background_bottom, 1);
  block.grid = glm::vec4(options.palette.grid, grid_spacing(radius));
  shared->frame.write(GL_UNIFORM_BUFFER, &block, sizeof block);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, shared->frame.id());
}

void ClothRenderer::Parts::draw_shadow(const ViewOptions& options) {
  if (!options.shadows || (!shadow_stale && shadow_of_cloth == options.lit())) return;
  const Stopwatch watch(work.shadow);
  shadow.begin();
  if (!one_weight() && options.lit()) {
    shared->cloth_depth.use();
    mesh.draw(ClothMesh::List::triangles, GL_TRIANGLES);
  }
  shared->solid_depth.use();
  for (const Body& body : preset.bodies) {
    if (body.shape != Body::Shape::sphere || one_weight()) continue;
    shared->solid_depth.set("placed", glm::vec4(glm::vec3(body.c), drawn_radius(body, preset.L)));
    shared->sphere.draw();
  }
  if (one_weight()) {
    shared->solid_depth.set("placed", glm::vec4(0, 0, 0, 1));
    spring.draw();
    hanger.draw();
    shared->solid_depth.set("placed", glm::vec4(weight_model.weight, weight_model.radius));
    shared->sphere.draw();
  }
  shadow.end();
  shadow_stale = false;
  shadow_of_cloth = options.lit();
}

void ClothRenderer::Parts::draw_background() {
  shared->background.use();
  glDepthMask(GL_FALSE);
  glBindVertexArray(shared->nothing.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
}

void ClothRenderer::Parts::draw_ground(const ViewOptions& options) {
  const glm::vec3 centre = (framed.lo + framed.hi) / 2.0f;
  // The lines have faded out before the square ends (ground.frag).
  const float half = 8.6f * scene_radius();
  glEnable(GL_BLEND);
  glBindVertexArray(shared->nothing.id());
  shared->ground.use();
  shared->ground.set("area", glm::vec4(centre.x - half, centre.z - half, centre.x + half, centre.z + half));
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  if (options.shadows && !box.empty()) {
    shared->ground_shadow.use();
    shared->ground_shadow.set("shadow_map", shadow_unit);
    shared->ground_shadow.set("area", shadow_area(box, to_light, ground_y));
    // Upon the lines, not flickering through them.
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(-1, -4);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    glDisable(GL_POLYGON_OFFSET_FILL);
  }
  glDisable(GL_BLEND);
}

void ClothRenderer::Parts::draw_solid(const SolidMesh& what, glm::vec4 placed, glm::vec3 base, float gloss) {
  shared->solid.use();
  shared->solid.set("shadow_map", shadow_unit);
  shared->solid.set("placed", placed);
  shared->solid.set("base", base);
  shared->solid.set("gloss", gloss);
  what.draw();
}

void ClothRenderer::Parts::draw_bodies(const ViewOptions& options) {
  for (const Body& body : preset.bodies) {
    if (body.shape != Body::Shape::sphere) continue;
    draw_solid(shared->sphere, glm::vec4(glm::vec3(body.c), drawn_radius(body, preset.L)), options.palette.body, 0.12f);
  }
}

void ClothRenderer::Parts::draw_weight(const ViewOptions& options) {
  const glm::vec4 here(0, 0, 0, 1);
  const Palette& colours = options.palette;
  draw_solid(hanger, here, 0.6f * colours.body, 0.05f);
  draw_solid(spring, here, colours.body, 0.5f);
  draw_solid(shared->sphere, glm::vec4(weight_model.weight, weight_model.radius), colours.lines, 0.25f);
  shared->solid.set("own_light", 1.0f);
  draw_solid(rest_line, here, 0.8f * colours.points, 0);
  draw_solid(equilibrium_line, here, colours.pins, 0);
  shared->solid.set("own_light", 0.0f);
}

/// Uses a program: of a coloured cloth the second one, with what colours it.
const gl::Program& ClothRenderer::Parts::use(const gl::Program& plain, const gl::Program* colored,
                                             const ViewOptions& options) {
  const gl::Program& program = options.colored && colored != nullptr ? *colored : plain;
  program.use();
  if (&program == &plain) return plain;
  const ValueRange& range = *options.colored;
  program.set("stride", mesh.stride());
  program.set("values", values_unit);
  program.set("color_map", colors_unit);
  program.set("value_range", glm::vec2(range.lo, 1 / std::max(range.hi - range.lo, 1e-30f)));
  return program;
}

void ClothRenderer::Parts::draw_triangles(const ViewOptions& options) {
  const Lattice& lattice = mesh.lattice();
  const glm::vec2 steps(std::max(lattice.columns - 1, 1), std::max(lattice.rows - 1, 1));
  const gl::Program& cloth = use(shared->cloth, shared->colored ? &shared->colored->cloth : nullptr, options);
  cloth.set("cloth", texture_unit);
  cloth.set("shadow_map", shadow_unit);
  cloth.set("stride", mesh.stride());
  cloth.set("texture_step", 1.0f / steps);
  cloth.set("hem", options.palette.hem);
  cloth.set("hem_width", hem_part * std::min(steps.x, steps.y) / steps);
  mesh.draw(ClothMesh::List::triangles, GL_TRIANGLES);
}

void ClothRenderer::Parts::draw_lines(ClothMesh::List list, const ViewOptions& options, float opacity, float width) {
  const gl::Program& lines = use(shared->lines, shared->colored ? &shared->colored->lines : nullptr, options);
  lines.set("spacing", spacing());
  lines.set("max_width", width);
  lines.set("ink", glm::vec4(options.palette.lines, opacity));
  glEnable(GL_BLEND);
  mesh.draw(list, GL_LINES);
  glDisable(GL_BLEND);
}

/// In a colour of their own, whatever colours the cloth.
void ClothRenderer::Parts::draw_bending(const ViewOptions& options) {
  ViewOptions own = options;
  own.colored.reset();
  own.palette.lines = options.palette.bending;
  draw_lines(ClothMesh::List::bending, own, 1, 0.6f * options.line_width);
}

void ClothRenderer::Parts::draw_points(const ViewOptions& options) {
  const gl::Program& points = use(shared->points, shared->colored ? &shared->colored->points : nullptr, options);
  points.set("spacing", spacing());
  points.set("diameter", glm::vec3(0.42f, 1.6f, options.point_size));
  points.set("towards", 0.0f);
  points.set("ink", glm::vec4(options.palette.points, 1));
  points.set("rim", 0.0f);
  points.set("ring", 0.0f);
  glEnable(GL_BLEND);
  mesh.draw(ClothMesh::List::particles, GL_POINTS);
  glDisable(GL_BLEND);
}

void ClothRenderer::Parts::draw_marks(const ViewOptions& options) {
  shared->points.use();
  shared->points.set("spacing", spacing());
  shared->points.set("towards", 0.03f);
  glEnable(GL_BLEND);
  shared->points.set("diameter", glm::vec3(0.5f, 4.0f, options.point_size));
  shared->points.set("ink", glm::vec4(options.palette.pins, 1));
  shared->points.set("rim", 1.2f);
  shared->points.set("ring", 0.0f);
  mesh.draw(ClothMesh::List::pins, GL_POINTS);
  if (options.highlighted) {
    const float size = 1.8f * options.point_size;
    shared->points.set("diameter", glm::vec3(0, size, size));
    shared->points.set("ink", glm::vec4(options.palette.highlight, 1));
    shared->points.set("ring", 0.2f * options.point_size);
    glDisable(GL_DEPTH_TEST);
    mesh.draw_particle(options.highlighted->i / every, options.highlighted->j / every);
    glEnable(GL_DEPTH_TEST);
  }
  glDisable(GL_BLEND);
}

/// Seen through whatever hangs before it, since it is there to be compared.
void ClothRenderer::Parts::draw_ghost(const Parts& other, glm::vec3 colour, float width) {
  const WeightModel& weight = other.weight_model;
  if (other.one_weight()) return draw_solid(shared->sphere, glm::vec4(weight.weight, weight.radius), colour, 0.25f);
  shared->lines.use();
  shared->lines.set("spacing", other.spacing());
  shared->lines.set("max_width", width);
  shared->lines.set("ink", glm::vec4(colour, ghost_opacity));
  glEnable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  other.mesh.draw(ClothMesh::List::outlines, GL_LINES);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
}

void ClothRenderer::Parts::draw_opaque(const ViewOptions& options) {
  if (one_weight()) return draw_weight(options);
  draw_bodies(options);
  if (options.lit()) draw_triangles(options);
}

void ClothRenderer::Parts::draw_blended(const ViewOptions& options) {
  const float width = options.line_width;
  switch (options.mode) {
    case 2:
      draw_lines(ClothMesh::List::diagonal, options, options.colored ? 0.8f : 0.5f, 0.7f * width);
      draw_lines(ClothMesh::List::straight, options, 1, width);
      if (options.bending) draw_bending(options);
      break;
    case 3:
      draw_lines(ClothMesh::List::connections, options, 1, width);
      break;
    case 4:
      draw_lines(ClothMesh::List::outlines, options, 1, width);
      break;
    case 5:
      draw_points(options);
      break;
    default:
      break;
  }
  draw_marks(options);
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
  for (const GLenum on : {GL_DEPTH_TEST, GL_MULTISAMPLE, GL_PROGRAM_POINT_SIZE}) glEnable(on);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  glBlendEquation(GL_FUNC_ADD);

  p.timer.begin();
  p.fill_frame(camera, options, width, height);
  p.draw_shadow(options);
  p.target.begin(width, height, options.samples);
  glClear(GL_DEPTH_BUFFER_BIT);
  p.shared->texture.bind(texture_unit);
  p.shadow.bind(shadow_unit);
  if (options.colored && p.shared->colored) p.values.bind(values_unit), p.shared->colored->map.bind(colors_unit);
  p.draw_opaque(options);
  p.draw_background();
  if (options.ground) p.draw_ground(options);
  if (!p.one_weight()) p.draw_blended(options);
  for (const Ghost& ghost : ghosts) p.draw_ghost(*ghost.cloth->parts_, ghost.colour, options.line_width);
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
