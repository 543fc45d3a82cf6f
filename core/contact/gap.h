// The shortest line between two parts of a cloth: a particle and a triangle, or two edges.
#pragma once

#include <array>
#include <glm/vec3.hpp>

namespace tyglab {

struct Gap {
  std::array<double, 4> weights;  ///< of the pair's particles: Σ w x leads from the second part to the first
  glm::dvec3 between{0};          ///< that sum, m
  bool edges = false;             ///< of two edges
};
/// From a point to a triangle.
Gap gap_to_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle);
/// From an edge to another.
Gap gap_of_edges(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b);

}  // namespace tyglab
