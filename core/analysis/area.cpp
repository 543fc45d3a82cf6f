#include "core/analysis/area.h"

#include <cstddef>
#include <glm/geometric.hpp>

namespace tyglab {

double cloth_area(Simulation& simulation) {
  const VectorField<double>& x = simulation.read().x;
  const auto at = [&](int n) { return glm::dvec3(x.x[std::size_t(n)], x.y[std::size_t(n)], x.z[std::size_t(n)]); };
  double area = 0;
  for_each_triangle(simulation.tears(), [&](int a, int b, int c, int, int, int) {
    area += glm::length(glm::cross(at(b) - at(a), at(c) - at(a))) / 2;
  });
  return area;
}

}  // namespace tyglab
