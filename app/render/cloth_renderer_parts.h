// The members of a ClothRenderer: cloth_renderer.cpp updates it and draws a frame, cloth_drawing.cpp draws each part.
// Only these two include this file.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <utility>

#include "app/render/cloth_mesh.h"
#include "app/render/cloth_renderer.h"
#include "app/render/cloth_texture.h"
#include "app/render/field_colors.h"
#include "app/render/gl_objects.h"
#include "app/render/render_target.h"
#include "app/render/solid_mesh.h"

namespace tyglab {

/// The parts that only a cloth colored by values needs.
struct ColoredCloth {
  gl::Program cloth{{"cloth.vert", "cloth.frag", "COLORED"}};
  gl::Program frayed{{"fray.vert", "fray.frag", "COLORED"}};
  gl::Program lines{{"lines.vert", "lines.frag", "COLORED"}};
  gl::Program points{{"points.vert", "points.frag", "COLORED"}};
  ValueTexture map{GL_LINEAR};
};

/// The parts that all cloths of a window share.
struct ClothRenderer::Shared {
  gl::Program background{{"background.vert", "background.frag"}};
  gl::Program ground{{"ground.vert", "ground.frag"}};
  gl::Program plane{{"ground.vert", "plane.frag"}};
  gl::Program cloth{{"cloth.vert", "cloth.frag"}};
  gl::Program frayed{{"fray.vert", "fray.frag"}};
  gl::Program solid{{"solid.vert", "solid.frag"}};
  gl::Program lines{{"lines.vert", "lines.frag"}};
  gl::Program points{{"points.vert", "points.frag"}};
  gl::Program cloth_depth{{"cloth_depth.vert", "depth.frag"}};
  gl::Program solid_depth{{"solid_depth.vert", "depth.frag"}};
  gl::Buffer frame;
  gl::VertexArray nothing;  ///< core profile draws with an array bound, even an empty one
  ClothTexture texture;
  SolidMesh sphere{sphere_geometry(64, 40)};
  SolidMesh box{box_geometry(glm::vec3(0), glm::vec3(1))};
  SolidMesh cylinder{cylinder_geometry(64)};
  std::optional<ColoredCloth> colored;  ///< made when it is first asked for
  std::shared_ptr<PositionLoans> loans = std::make_shared<PositionLoans>();
};

struct ClothRenderer::Parts {
  /// The texture units used while the cloth is drawn.
  static constexpr int texture_unit = 0, shadow_unit = 1, values_unit = 2, colors_unit = 3, positions_unit = 4,
                       lines_unit = 5, normals_unit = 6, copies_unit = 7;
  static inline const glm::vec3 to_light = glm::normalize(glm::vec3(-0.66f, 0.86f, 0.60f));

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
  bool has_plane = false;  ///< at that height; otherwise there is nothing but a grid that shows where the scene ends
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
  void draw_square(const gl::Program& program, float half);
  void draw_grid();
  void draw_plane(const Camera& camera, const ViewOptions& options);
  void draw_solid(const SolidMesh& mesh, const glm::mat4& placed, glm::vec3 base, float gloss);
  /// A unit mesh with its place in the world.
  struct SolidPart {
    const SolidMesh* mesh;
    glm::mat4 placed;
  };
  std::vector<SolidPart> parts_of(const Body& body) const;
  void draw_bodies(const ViewOptions& options);
  void draw_weight(const ViewOptions& options);
  void set_surface(const gl::Program& program, const ViewOptions& options);
  void draw_triangles(const ViewOptions& options);
  void draw_frayed(const ViewOptions& options);
  const gl::Program& use(const gl::Program& plain, const gl::Program* colored, const ViewOptions& options);
  void draw_lines(ClothMesh::List list, const ViewOptions& options, float opacity, float width);
  static void draw_lines_of(const ClothMesh& of, const gl::Program& lines, ClothMesh::List list);
  void draw_bending(const ViewOptions& options);
  void draw_points(const ViewOptions& options);
  void draw_marks(const ViewOptions& options);
  void draw_ghost(const Parts& other, glm::vec3 color, float width);
  void draw_opaque(const ViewOptions& options);
  void draw_blended(const ViewOptions& options);
  float scene_radius() const { return std::max(glm::length(framed.hi - framed.lo) / 2, 1e-4f); }
  float spacing() const { return float(preset.L * every); }
  bool one_weight() const { return preset.kind == Kind::one_weight; }
};

}  // namespace tyglab
