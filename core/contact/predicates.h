// On which side points lie, exactly: floating point with a bound of its error decides nearly always, exact numbers
// otherwise. J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates",
// Discrete & Computational Geometry 18 (1997), whose bounds of the first stage these are.
#pragma once

#include <glm/vec3.hpp>

namespace tyglab {

/// The sign (-1, 0 or 1) of (a - d)·((b - d) × (c - d)), six times the volume of a tetrahedron: 0 if the points lie in
/// one plane. Coordinates must be finite.
int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

/// The sign of the area of a triangle of which the coordinate `dropped` (0, 1 or 2) is left out: 0 if the three points
/// lie on one line there.
int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int dropped);

}  // namespace tyglab
