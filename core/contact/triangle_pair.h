// Whether two triangles of a mesh cross or touch, exactly.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace tyglab {

using Triangle = std::array<glm::dvec3, 3>;

/// Whether the closed triangles have a point in common that is not of the corner or edge that they share: their first
/// `shared` (0, 1 or 2) corners are the same ones. Triangles in one plane, without area, and such that only touch are
/// decided by the same rule. Coordinates must be finite.
bool triangles_cross(const Triangle& a, const Triangle& b, int shared);

}  // namespace tyglab
