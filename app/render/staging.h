// Sizes and positions of objects around the cloth.
#pragma once

#include "core/model/preset.h"

namespace tyglab {

/// Drawn spheres stay inside the computed ones, so that the flat triangles between particles on them do not cut in.
float drawn_radius(const Body& sphere, double L);
/// A round distance between the ground's lines for a scene of that radius, m: 1, 2 or 5 times a power of ten.
float grid_spacing(float radius);

}  // namespace tyglab
