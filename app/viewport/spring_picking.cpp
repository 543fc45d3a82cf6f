#include "app/viewport/spring_picking.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace tyglab {
namespace {

/// Spheres are drawn a little inside the computed ones, so cloth that rests on one is before it.
constexpr double drawn_part = 0.98;

/// Twice the area of the triangle a, b, p: above 0 where p lies to one side of the line from a to b.
double side(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// A particle in the picture, and on which side of the stroke's line it is. A point on the line counts to one side
/// alone, so that strokes that follow each other miss nothing between them.
struct Seen {
  glm::dvec2 at{0};
  bool seen = false, beyond = false;
};

class Stroke {
 public:
  Stroke(const Camera& camera, std::span<const Body> bodies, glm::vec2 from, glm::vec2 to, glm::vec2 size)
      : project_(camera, size), eye_(camera.eye()), bodies_(bodies), from_(from), to_(to) {}

  std::vector<Seen> row(const PositionView& positions, int i) const {
    std::vector<Seen> pictures(std::size_t(positions.columns));
    for (int j = 0; j < positions.columns; ++j) {
      const auto pixel = project_(positions.at(i, j));
      if (!pixel || !std::isfinite(pixel->x) || !std::isfinite(pixel->y)) continue;
      pictures[std::size_t(j)] = {*pixel, true, side(from_, to_, *pixel) < 0};
    }
    return pictures;
  }

  bool crosses(const Seen& a, const Seen& b) const {
    if (!a.seen || !b.seen || a.beyond == b.beyond) return false;
    return (side(a.at, b.at, from_) < 0) != (side(a.at, b.at, to_) < 0);
  }

  /// Whether a sphere stands before the place at which the spring between a and b is crossed.
  bool hidden(const Seen& a, const Seen& b, glm::dvec3 x_a, glm::dvec3 x_b) const {
    const double to_a = std::abs(side(from_, to_, a.at)), to_b = std::abs(side(from_, to_, b.at));
    const glm::dvec3 at = x_a + (to_a + to_b > 0 ? to_a / (to_a + to_b) : 0.5) * (x_b - x_a);
    const double far = glm::distance(at, eye_);
    const glm::dvec3 ray = (at - eye_) / far;
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
      if (body.shape != Body::Shape::sphere) return false;
      const glm::dvec3 to_centre = body.c - eye_;
      const double along = glm::dot(ray, to_centre), r = drawn_part * body.r;
      const double half_chord2 = r * r - (glm::dot(to_centre, to_centre) - along * along);
      return half_chord2 > 0 && along > 0 && along - std::sqrt(half_chord2) < far;
    });
  }

 private:
  Projector project_;
  glm::dvec3 eye_;
  std::span<const Body> bodies_;
  glm::dvec2 from_, to_;
};

}  // namespace

std::vector<SpringSite> springs_across(const PositionView& positions, const Tears& tears, const Camera& camera,
                                       std::span<const Body> bodies, glm::vec2 from, glm::vec2 to, glm::vec2 size) {
  std::vector<SpringSite> met;
  if (from == to) return met;
  const Stroke stroke(camera, bodies, from, to, size);
  std::vector<Seen> row = stroke.row(positions, 0), below;
  for (int i = 0; i < positions.rows; ++i, row.swap(below)) {
    if (i + 1 < positions.rows) below = stroke.row(positions, i + 1);
    for (int j = 0; j < positions.columns; ++j)
      for (int direction = 0; direction < stretch_directions; ++direction) {
        if (!tears.lattice().has_spring(direction, i, j)) continue;
        const Direction& d = directions[std::size_t(direction)];
        const Seen &a = row[std::size_t(j)], &b = (d.di == 0 ? row : below)[std::size_t(j + d.dj)];
        if (!stroke.crosses(a, b) || !tears.whole(direction, i, j)) continue;
        if (stroke.hidden(a, b, positions.at(i, j), positions.at(i + d.di, j + d.dj))) continue;
        met.push_back({direction, i, j});
      }
  }
  return met;
}

}  // namespace tyglab
