// Which springs a stroke across the picture meets.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "app/viewport/camera.h"
#include "core/cloth/tears.h"
#include "core/engines/engine.h"

namespace tyglab {

/// The whole stretch springs, edges of triangles among them, whose pictures the way from `from` to `to` (pixels)
/// crosses: through all layers of the cloth, as scissors go, but not through what a sphere hides. A spring that meets
/// the end of one way and the beginning of the next is crossed by one of them. In the order of their owners.
std::vector<SpringSite> springs_across(const PositionView& positions, const Tears& tears, const Camera& camera,
                                       std::span<const Body> bodies, glm::vec2 from, glm::vec2 to, glm::vec2 size);

}  // namespace tyglab
