// Finds the springs that a stroke across the picture crosses.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "app/render/camera.h"
#include "core/cloth/tears.h"
#include "core/engines/engine.h"

namespace tyglab {

/// A way across the picture, pixels.
struct Stroke {
  glm::vec2 from, to;
};

/// The whole stretch springs, edges of triangles among them, whose pictures one of the ways crosses: through all layers
/// of the cloth, as scissors go, but not through what a sphere hides. A spring that meets the end of one way and the
/// beginning of the next is crossed by one of them. Each stands once, in the order of their owners.
std::vector<SpringSite> springs_across(const PositionView& positions, const Tears& tears, const Camera& camera,
                                       std::span<const Body> bodies, std::span<const Stroke> strokes, glm::vec2 size);

}  // namespace tyglab
