// Sizes and positions of objects around the cloth.
#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "app/render/camera.h"
#include "core/model/preset.h"

namespace tyglab {

/// Drawn spheres stay inside the computed ones, so that the flat triangles between particles on them do not cut in.
float drawn_radius(const Body& sphere, double L);
/// A round distance between the ground's lines for a scene of that radius, m: 1, 2 or 5 times a power of ten.
float grid_spacing(float radius);
/// Where on the ground at that height the shadow of a box falls: least x and z, greatest x and z, m.
glm::vec4 shadow_area(const Bounds& box, glm::vec3 to_light, float ground);

}  // namespace tyglab
