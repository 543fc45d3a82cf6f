// Small triangle meshes with normals: the sphere, and the spring of the mass on a spring.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "app/render/gl_objects.h"
#include "core/model/preset.h"

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
/// Round y, of radius 1, from y = -1 to 1, with both ends.
SolidGeometry cylinder_geometry(int meridians);
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

// The drawable parts of the mass on a spring (figure 3.2).

struct WeightModel {
  SolidGeometry spring, hanger;
  SolidGeometry rest;         ///< an unbroken line at x_0
  SolidGeometry equilibrium;  ///< a broken line where gravity and spring balance, at x_0 − m g/k
  glm::vec3 weight{0};        ///< center of the weight
  float radius = 0;           ///< of the weight, m
};

/// The model for the weight at `position`. A weight that has gone out of all bounds is drawn at their end.
WeightModel weight_model(const Preset& preset, glm::dvec3 position);

}  // namespace tyglab
