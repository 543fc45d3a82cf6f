// The drawable parts of the mass on a spring (figure 3.2).
#pragma once

#include <glm/vec3.hpp>

#include "app/render/solid_mesh.h"
#include "core/model/preset.h"

namespace tyglab {

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
