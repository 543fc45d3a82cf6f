#include "core/analysis/pierced.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "core/forces/contact.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

/// The depth of the deepest point of a body, m.
double thickness(const Body& body) {
  switch (body.shape) {
    case Body::Shape::plane:
      return std::numeric_limits<double>::infinity();
    case Body::Shape::box:
      return std::min({body.size.x, body.size.y, body.size.z}) / 2;
    case Body::Shape::cylinder:
      return std::min(body.r, body.length / 2);
    case Body::Shape::sphere:
    case Body::Shape::capsule:
      break;
  }
  return body.r;
}

/// The largest depth on the line between two points, m. Bodies are convex: along the line it has one maximum.
double deepest_between(const PlacedBody& body, const glm::dvec3& from, const glm::dvec3& to) {
  constexpr int sections = 24;
  double low = 0, high = 1;
  const auto at = [&](double part) { return depth(body, from + part * (to - from)); };
  for (int n = 0; n < sections; ++n) {
    const double third = (high - low) / 3;
    if (at(low + third) < at(high - third))
      low += third;
    else
      high -= third;
  }
  return at((low + high) / 2);
}

/// A body, and from which depth on a spring lies across it.
struct Obstacle {
  PlacedBody body;
  double limit, tolerance;  ///< m
  std::size_t index;        ///< in the preset
  int springs = 0;
};

bool pierces(const Obstacle& one, const glm::dvec3& from, const glm::dvec3& to) {
  const glm::dvec3 middle = (from + to) / 2.0, c(one.body.c[0], one.body.c[1], one.body.c[2]);
  const double half = glm::distance(from, to) / 2;
  if (glm::distance(middle, c) > one.body.extent + half) return false;
  // No point of it is deeper than its middle by more than half its length.
  if (depth(one.body, middle) + half <= one.limit) return false;
  if (depth(one.body, from) > one.tolerance || depth(one.body, to) > one.tolerance) return false;
  return deepest_between(one.body, from, to) > one.limit;
}

}  // namespace

Pierced pierced_springs(const Simulation& simulation) {
  const Preset& preset = simulation.preset();
  if (preset.kind != Kind::cloth || simulation.divergence()) return {};
  std::vector<Obstacle> obstacles;
  const std::vector<Body> bodies = simulation.bodies();
  // No line between two points above a plane leads through it.
  for (std::size_t n = 0; n < bodies.size(); ++n)
    if (bodies[n].shape != Body::Shape::plane)
      obstacles.push_back({placed(bodies[n]), std::min(thickness(bodies[n]) / 2, 0.75 * preset.L), 0.01 * preset.L, n});
  if (obstacles.empty()) return {};
  const PositionView x = simulation.positions();
  const auto held = simulation.held();
  const auto fixed = [&](int i, int j) { return simulation.pinned(i, j) || (held && *held == Pins::Site{i, j}); };
  Pierced found;
  const auto look = [&](int d, int i, int j) {
    const Direction& to = directions[std::size_t(d)];
    if (!simulation.lattice().has_spring(d, i, j) || !simulation.tears().whole(d, i, j)) return;
    const glm::dvec3 from_x = x.at(i, j), to_x = x.at(i + to.di, j + to.dj);
    const auto hit = std::find_if(obstacles.begin(), obstacles.end(),
                                  [&](const Obstacle& one) { return pierces(one, from_x, to_x); });
    if (hit == obstacles.end() || fixed(i, j) || fixed(i + to.di, j + to.dj)) return;
    ++found.springs, ++hit->springs;
  };
  for (int i = 0; i < x.rows; ++i)
    for (int j = 0; j < x.columns; ++j)
      for (int d = 0; d < stretch_directions; ++d) look(d, i, j);
  const auto most = std::max_element(obstacles.begin(), obstacles.end(),
                                     [](const Obstacle& a, const Obstacle& b) { return a.springs < b.springs; });
  if (found.springs > 0) found.body = int(most->index);
  return found;
}

std::string pierced_in_words(const Simulation& simulation) {
  const Pierced found = pierced_springs(simulation);
  if (found.springs == 0) return "";
  const Preset& preset = simulation.preset();
  return "The " + std::string(name_of(preset.bodies[std::size_t(found.body)].shape)) + " comes through the cloth: " +
         (found.springs == 1 ? "one spring lies" : std::to_string(found.springs) + " springs lie") +
         " across it, since only particles meet bodies. Use a finer cloth (more rows and columns), or a body that is "
         "large beside L = " +
         quantity(preset.L, "m") + ".";
}

}  // namespace tyglab
