#include "app/render/spring_picking.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "app/render/picking.h"

namespace tyglab {
namespace {

/// Spheres are drawn a little inside the computed ones, so cloth that rests on one is before it.
constexpr double drawn_part = 0.98;

/// Twice the area of the triangle a, b, p: above 0 where p lies to one side of the line from a to b.
double side(glm::dvec2 a, glm::dvec2 b, glm::dvec2 p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// A particle in the picture.
struct Seen {
  glm::dvec2 at{0};
  bool seen = false;
};

/// Whether the way and the spring from a to b cross. A point on a line counts to one side of it alone, so that ways
/// that follow each other miss nothing between them.
bool cross(const Stroke& stroke, const Seen& a, const Seen& b) {
  const glm::dvec2 from = stroke.from, to = stroke.to;
  return (side(from, to, a.at) < 0) != (side(from, to, b.at) < 0) &&
         (side(a.at, b.at, from) < 0) != (side(a.at, b.at, to) < 0);
}

class StrokeSet {
 public:
  StrokeSet(const Camera& camera, std::span<const Body> bodies, std::span<const Stroke> strokes, glm::vec2 size)
      : project_(camera, size), eye_(camera.eye()), bodies_(bodies), strokes_(strokes) {
    for (const Stroke& stroke : strokes) {
      lo_ = glm::min(lo_, glm::dvec2(glm::min(stroke.from, stroke.to)));
      hi_ = glm::max(hi_, glm::dvec2(glm::max(stroke.from, stroke.to)));
    }
  }

  void look(const PositionView& positions, int i, std::vector<Seen>& row) const {
    row.assign(std::size_t(positions.columns), {});
    for (int j = 0; j < positions.columns; ++j) {
      const auto pixel = project_(positions.at(i, j));
      if (pixel && std::isfinite(pixel->x) && std::isfinite(pixel->y)) row[std::size_t(j)] = {*pixel, true};
    }
  }

  /// The way that crosses the spring between a and b; null: none does.
  const Stroke* across(const Seen& a, const Seen& b) const {
    if (!a.seen || !b.seen || far_off(a.at, b.at)) return nullptr;
    const auto found =
        std::find_if(strokes_.begin(), strokes_.end(), [&](const Stroke& stroke) { return cross(stroke, a, b); });
    return found == strokes_.end() ? nullptr : &*found;
  }

  /// Whether a sphere stands before the place at which the way crosses the spring between a and b.
  bool hidden(const Stroke& stroke, const Seen& a, const Seen& b, glm::dvec3 x_a, glm::dvec3 x_b) const {
    const double to_a = std::abs(side(stroke.from, stroke.to, a.at)),
                 to_b = std::abs(side(stroke.from, stroke.to, b.at));
    const glm::dvec3 at = x_a + (to_a + to_b > 0 ? to_a / (to_a + to_b) : 0.5) * (x_b - x_a);
    const double far = glm::distance(at, eye_);
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
      if (body.shape != Body::Shape::sphere) return false;
      const auto surface = sphere_surface(eye_, (at - eye_) / far, body.c, drawn_part * body.r);
      return surface && *surface < far;
    });
  }

 private:
  /// Most springs: beside the box round all ways.
  bool far_off(glm::dvec2 a, glm::dvec2 b) const {
    return std::max(a.x, b.x) < lo_.x || std::min(a.x, b.x) > hi_.x || std::max(a.y, b.y) < lo_.y ||
           std::min(a.y, b.y) > hi_.y;
  }

  Projector project_;
  glm::dvec3 eye_;
  std::span<const Body> bodies_;
  std::span<const Stroke> strokes_;
  glm::dvec2 lo_{std::numeric_limits<double>::max()}, hi_{std::numeric_limits<double>::lowest()};
};

}  // namespace

std::vector<SpringSite> springs_across(const PositionView& positions, const Tears& tears, const Camera& camera,
                                       std::span<const Body> bodies, std::span<const Stroke> strokes, glm::vec2 size) {
  std::vector<SpringSite> met;
  const StrokeSet stroke_set(camera, bodies, strokes, size);
  std::vector<Seen> row, below;
  stroke_set.look(positions, 0, row);
  for (int i = 0; i < positions.rows; ++i, row.swap(below)) {
    if (i + 1 < positions.rows) stroke_set.look(positions, i + 1, below);
    for (int j = 0; j < positions.columns; ++j)
      for (int direction = 0; direction < stretch_directions; ++direction) {
        if (!tears.lattice().has_spring(direction, i, j)) continue;
        const Direction& d = directions[std::size_t(direction)];
        const Seen &a = row[std::size_t(j)], &b = (d.di == 0 ? row : below)[std::size_t(j + d.dj)];
        const Stroke* stroke = stroke_set.across(a, b);
        if (stroke == nullptr || !tears.whole(direction, i, j)) continue;
        if (stroke_set.hidden(*stroke, a, b, positions.at(i, j), positions.at(i + d.di, j + d.dj))) continue;
        met.push_back({direction, i, j});
      }
  }
  return met;
}

}  // namespace tyglab
