// Draws the parts of a picture in order: shadows, ground, bodies or a weight, and the cloth in its five views.
#include <algorithm>

#include "app/render/cloth_renderer_parts.h"
#include "core/forces/contact.h"

namespace tyglab {
namespace {

constexpr float ghost_opacity = 0.9f;
constexpr float hem_part = 0.007f;  ///< of the cloth's shorter side

/// A unit sphere at that place, of that radius.
glm::mat4 round_at(glm::vec3 center, float radius) {
  glm::mat4 placed(radius);
  placed[3] = glm::vec4(center, 1);
  return placed;
}

}  // namespace

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
    // A tilted plane would darken all that lies below it.
    if (body.shape == Body::Shape::plane) continue;
    for (const SolidPart& part : parts_of(body)) {
      shared->solid_depth.set("placed", part.placed);
      part.mesh->draw();
    }
  }
  if (one_weight()) {
    shared->solid_depth.set("placed", glm::mat4(1));
    spring.draw();
    hanger.draw();
    shared->solid_depth.set("placed", round_at(weight_model.weight, weight_model.radius));
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

/// A square of the ground's height round the middle of the scene, for a program that is in use.
void ClothRenderer::Parts::draw_square(const gl::Program& program, float half) {
  const glm::vec3 center = (framed.lo + framed.hi) / 2.0f;
  program.set("area", glm::vec4(center.x - half, center.z - half, center.x + half, center.z + half));
  glEnable(GL_BLEND);
  glBindVertexArray(shared->nothing.id());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDisable(GL_BLEND);
}

/// A grid that nothing lands on: it hides nothing that has fallen below it, and there are no shadows on it.
void ClothRenderer::Parts::draw_grid() {
  shared->ground.use();
  glDepthMask(GL_FALSE);
  draw_square(shared->ground, 8.6f * scene_radius());  // the lines have faded out before it ends (ground.frag)
  glDepthMask(GL_TRUE);
}

/// A disc that reaches some way beyond the cloth, with shadows. From below one sees through it.
void ClothRenderer::Parts::draw_plane(const Camera& camera, const ViewOptions& options) {
  constexpr float least = 2.2f, beyond = 0.7f, most = 40;  // of the scene's radius
  const float radius = scene_radius();
  const glm::vec3 center = (framed.lo + framed.hi) / 2.0f;
  const auto apart = [&](glm::vec3 at) { return glm::length(glm::vec2(at.x - center.x, at.z - center.z)); };
  const float reach = box.empty() ? 0 : std::max(apart(box.lo), apart(box.hi));
  const float of_disc = std::max(least * radius, std::min(reach + beyond * radius, most * radius));
  const bool above = camera.eye().y > ground_y;
  shared->plane.use();
  shared->plane.set("shadow_map", shadow_unit);
  shared->plane.set("disc", glm::vec4(center.x, center.z, of_disc, above ? 1 : 0.2f));
  shared->plane.set("ink", options.palette.plane);
  glDepthMask(above ? GL_TRUE : GL_FALSE);
  draw_square(shared->plane, 1.01f * of_disc);
  glDepthMask(GL_TRUE);
}

void ClothRenderer::Parts::draw_solid(const SolidMesh& what, const glm::mat4& placed, glm::vec3 base, float gloss) {
  shared->solid.use();
  shared->solid.set("shadow_map", shadow_unit);
  shared->solid.set("placed", placed);
  shared->solid.set("base", base);
  shared->solid.set("gloss", gloss);
  what.draw();
}

void ClothRenderer::Parts::draw_bodies(const ViewOptions& options) {
  for (const Body& body : preset.bodies)
    for (const SolidPart& part : parts_of(body))
      draw_solid(*part.mesh, part.placed,
                 body.shape == Body::Shape::plane ? glm::vec3(options.palette.plane) : options.palette.body, 0.12f);
}

/// Drawn a little inside the computed surface, so that cloth that rests on it is before it. A level plane is the
/// ground.
std::vector<ClothRenderer::Parts::SolidPart> ClothRenderer::Parts::parts_of(const Body& body) const {
  using Shape = Body::Shape;
  const PlacedBody at = placed(body);
  const glm::vec3 x(at.axes[0], at.axes[1], at.axes[2]), y(at.axes[3], at.axes[4], at.axes[5]),
      z(at.axes[6], at.axes[7], at.axes[8]), c(at.c[0], at.c[1], at.c[2]);
  const auto mesh_at = [&](const SolidMesh& unit, glm::vec3 half, glm::vec3 offset = glm::vec3(0)) {
    const glm::vec3 origin = c + offset.x * x + offset.y * y + offset.z * z;
    return SolidPart{&unit, glm::mat4(glm::vec4(half.x * x, 0), glm::vec4(half.y * y, 0), glm::vec4(half.z * z, 0),
                                      glm::vec4(origin, 1))};
  };
  const float r = drawn_radius(body, preset.L), length = float(body.length / 2);
  const auto within = [&](double half) { return float(half - std::min(0.12 * preset.L, 0.1 * half)); };
  switch (body.shape) {
    case Shape::sphere:
      return {mesh_at(shared->sphere, glm::vec3(r))};
    case Shape::box:
      return {mesh_at(shared->box, {within(body.size.x / 2), within(body.size.y / 2), within(body.size.z / 2)})};
    case Shape::cylinder:
      return {mesh_at(shared->cylinder, {r, within(body.length / 2), r})};
    case Shape::capsule:
      return {mesh_at(shared->cylinder, {r, length, r}), mesh_at(shared->sphere, glm::vec3(r), {0, length, 0}),
              mesh_at(shared->sphere, glm::vec3(r), {0, -length, 0})};
    case Shape::plane:
      break;
  }
  if (body.turn == glm::dvec3(0)) return {};
  constexpr float reach = 1.6f, thin = 0.004f;  // of the scene's radius
  const float half = reach * scene_radius(), depth = thin * scene_radius();
  const glm::vec3 middle = (framed.lo + framed.hi) / 2.0f - c;
  return {mesh_at(shared->box, {half, depth, half},
                  {glm::dot(middle, x), -depth - float(0.12 * preset.L), glm::dot(middle, z)})};
}

void ClothRenderer::Parts::draw_weight(const ViewOptions& options) {
  const glm::mat4 here(1);
  const Palette& colors = options.palette;
  draw_solid(hanger, here, 0.6f * colors.body, 0.05f);
  draw_solid(spring, here, colors.body, 0.5f);
  draw_solid(shared->sphere, round_at(weight_model.weight, weight_model.radius), colors.lines, 0.25f);
  shared->solid.set("own_light", 1.0f);
  draw_solid(rest_line, here, 0.8f * colors.points, 0);
  if (options.equilibrium) draw_solid(equilibrium_line, here, colors.pins, 0);
  shared->solid.set("own_light", 0.0f);
}

/// Uses a program: of a colored cloth the second one, with what colors it.
const gl::Program& ClothRenderer::Parts::use(const gl::Program& plain, const gl::Program* colored,
                                             const ViewOptions& options) {
  const gl::Program& program = options.colored && colored != nullptr ? *colored : plain;
  program.use();
  if (&program == &plain) return plain;
  const ValueRange& range = *options.colored;
  program.set("stride", mesh.stride());
  program.set("values", values_unit);
  program.set("color_map", colors_unit);
  program.set("value_range", glm::vec3(range.lo, 1 / std::max(range.hi - range.lo, 1e-30f), range.root ? 1.f : 0.f));
  return program;
}

/// What both programs need that draw the cloth's surface (cloth.frag).
void ClothRenderer::Parts::set_surface(const gl::Program& program, const ViewOptions& options) {
  const Lattice lattice = mesh.lattice().sites();
  const glm::vec2 steps(std::max(lattice.columns - 1, 1), std::max(lattice.rows - 1, 1));
  program.set("cloth", texture_unit);
  program.set("shadow_map", shadow_unit);
  program.set("stride", mesh.stride());
  program.set("texture_step", 1.0f / steps);
  program.set("site_rows", lattice.rows);
  program.set("columns", lattice.columns);
  program.set("copy_sites", copies_unit);
  mesh.bind_copy_sites(copies_unit);
  program.set("hem", options.palette.hem);
  program.set("hem_width", hem_part * std::min(steps.x, steps.y) / steps);
}

void ClothRenderer::Parts::draw_triangles(const ViewOptions& options) {
  set_surface(use(shared->cloth, shared->colored ? &shared->colored->cloth : nullptr, options), options);
  mesh.draw(ClothMesh::List::triangles, GL_TRIANGLES);
}

/// The edges of tears, over the background, since threads cover it only in part.
void ClothRenderer::Parts::draw_frayed(const ViewOptions& options) {
  const gl::Program& frayed = use(shared->frayed, shared->colored ? &shared->colored->frayed : nullptr, options);
  set_surface(frayed, options);
  frayed.set("positions", positions_unit);
  frayed.set("normals", normals_unit);
  frayed.set("pieces", lines_unit);
  frayed.set("component", mesh.stride() / 3);
  frayed.set("spacing", spacing());
  glEnable(GL_BLEND);
  mesh.draw_frayed(positions_unit, normals_unit, lines_unit);
  glDisable(GL_BLEND);
}

void ClothRenderer::Parts::draw_lines_of(const ClothMesh& of, const gl::Program& lines, ClothMesh::List list) {
  lines.set("positions", positions_unit);
  lines.set("lines", lines_unit);
  lines.set("component", of.stride() / 3);
  of.draw_lines(list, positions_unit, lines_unit);
}

void ClothRenderer::Parts::draw_lines(ClothMesh::List list, const ViewOptions& options, float opacity, float width) {
  const gl::Program& lines = use(shared->lines, shared->colored ? &shared->colored->lines : nullptr, options);
  lines.set("spacing", spacing());
  lines.set("max_width", width);
  lines.set("ink", glm::vec4(options.palette.lines, opacity));
  glEnable(GL_BLEND);
  draw_lines_of(mesh, lines, list);
  glDisable(GL_BLEND);
}

/// In a color of their own, whatever colors the cloth.
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
  points.set("toward", 0.0f);
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
  shared->points.set("toward", 0.03f);
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
void ClothRenderer::Parts::draw_ghost(const Parts& other, glm::vec3 color, float width) {
  const WeightModel& weight = other.weight_model;
  if (other.one_weight()) return draw_solid(shared->sphere, round_at(weight.weight, weight.radius), color, 0.25f);
  shared->lines.use();
  shared->lines.set("spacing", other.spacing());
  shared->lines.set("max_width", width);
  shared->lines.set("ink", glm::vec4(color, ghost_opacity));
  glEnable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  draw_lines_of(other.mesh, shared->lines, ClothMesh::List::outlines);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
}

void ClothRenderer::Parts::draw_opaque(const ViewOptions& options) {
  draw_bodies(options);
  if (one_weight()) return draw_weight(options);
  if (options.lit()) draw_triangles(options);
}

void ClothRenderer::Parts::draw_blended(const ViewOptions& options) {
  const float width = options.line_width;
  if (options.lit()) draw_frayed(options);
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

}  // namespace tyglab
