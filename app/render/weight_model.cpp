#include "app/render/weight_model.h"

#include <algorithm>
#include <cmath>

namespace tyglab {
namespace {

/// Where the weight is drawn: not through the hanger, and not out of all bounds.
glm::vec3 drawn_place(const Preset& p, double y, double scale) {
  if (!std::isfinite(y)) y = p.x_0.y;
  return {p.x_0.x, std::clamp(y, p.x_0.y - 1e4 * scale, p.x_0.y + 2.5 * scale), p.x_0.z};
}

void append(SolidGeometry& to, const SolidGeometry& more) {
  const auto first = std::uint32_t(to.vertices.size());
  to.vertices.insert(to.vertices.end(), more.vertices.begin(), more.vertices.end());
  for (const std::uint32_t index : more.indices) to.indices.push_back(first + index);
}

/// A level line of `dashes` pieces to both sides of `middle`, which leaves the middle itself free.
SolidGeometry level_line(glm::vec3 middle, float scale, int dashes) {
  const float from = 0.26f * scale, to = 1.0f * scale, thick = 0.006f * scale;
  const float piece = (to - from) / float(2 * dashes - 1);
  SolidGeometry line;
  for (int k = 0; k < dashes; ++k) {
    for (const float side : {-1.0f, 1.0f}) {
      const glm::vec3 offset(side * (from + (2 * float(k) + 0.5f) * piece), 0, 0);
      append(line, box_geometry(middle + offset, glm::vec3(piece / 2, thick, thick)));
    }
  }
  return line;
}

}  // namespace

WeightModel weight_model(const Preset& p, glm::dvec3 position) {
  const double sag = p.k > 0 ? p.m * p.g / p.k : 0;
  const double scale = std::clamp(std::max(std::abs(p.offset), std::abs(sag)), 0.02, 1e3);
  const float s = float(scale);
  const glm::vec3 rest(p.x_0), top = rest + glm::vec3(0, 3 * s, 0);
  WeightModel model;
  model.weight = drawn_place(p, position.y, scale);
  model.radius = 0.19f * s;
  model.hanger = box_geometry(top + glm::vec3(0, 0.03f * s, 0), glm::vec3(0.45f, 0.03f, 0.2f) * s);
  model.spring = coil_geometry(top, model.weight + glm::vec3(0, 0.95f * model.radius, 0), 12, 0.15f * s, 0.02f * s);
  model.rest = level_line(rest, s, 1);
  model.equilibrium = level_line(rest - glm::vec3(0, float(sag), 0), s, 6);
  return model;
}

}  // namespace tyglab
