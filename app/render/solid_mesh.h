// Small triangle meshes with normals: the sphere, and the spring of the mass on a spring.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "app/render/gl_objects.h"

namespace tyglab {

struct SolidVertex {
  glm::vec3 point, normal;
};

struct SolidGeometry {
  std::vector<SolidVertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// Unit sphere round the origin.
SolidGeometry sphere_geometry(int meridians, int parallels);
/// Box with half sides `half` round `center`.
SolidGeometry box_geometry(glm::vec3 center, glm::vec3 half);
/// A coil of wire from `top` straight down to `bottom` with straight ends.
SolidGeometry coil_geometry(glm::vec3 top, glm::vec3 bottom, int turns, float radius, float wire_radius);

class SolidMesh {
 public:
  SolidMesh() = default;
  explicit SolidMesh(const SolidGeometry& geometry) { upload(geometry); }
  void upload(const SolidGeometry& geometry);
  void draw() const;

 private:
  gl::VertexArray array_;
  gl::Buffer vertices_, indices_;
  GLsizei count_ = 0;
};

}  // namespace tyglab
