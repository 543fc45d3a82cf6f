
#include "app/render/picking.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "core/forces/contact.h"
#include "core/forces/parted.h"

namespace tyglab {
namespace {

/// Of two particles whose pictures are this near to each other, the one before the other is meant.
constexpr float same_place_px = 0.5f;

/// Pictures of all particles that could count, worked out once for a whole path.
struct Picture {
  Pins::Site site;
  glm::vec2 pixel;
  double depth;
};

/// Says quickly of many particles at a time whether one of them may be seen in a box of the picture.
class Sieve {
 public:
  static constexpr int block = 32;

  /// The box is given by two opposite corners, pixels.
  Sieve(const Camera& camera, glm::vec2 size, glm::vec2 a, glm::vec2 b)
      : eye_(camera.eye()), ahead_(camera.forward()), right_(camera.right()), down_(-camera.up()) {
    const float slope_per_pixel = 2 * std::tan(camera.fov_y / 2) / size.y;
    lo_ = slope_per_pixel * (glm::min(a, b) - 1.0f - size / 2.0f);
    hi_ = slope_per_pixel * (glm::max(a, b) + 1.0f - size / 2.0f);
    slack_ = 1e-6f * (glm::length(eye_) + camera.distance);  // what is lost in float
  }

  /// Of `count` particles from (i, j) on.
  bool any(const PositionView& view, int i, int j, int count) const {
    const std::size_t at = std::size_t(i) * view.stride + j;
    return view.f[0] != nullptr ? any(view.f[0] + at, view.f[1] + at, view.f[2] + at, count)
                                : any(view.d[0] + at, view.d[1] + at, view.d[2] + at, count);
  }

 private:
  /// Without a way out of the loop, so that the compiler can use SIMD.
  template <class R>
  bool any(const R* x, const R* y, const R* z, int count) const {
    int found = 0;
    for (int n = 0; n < count; ++n) {
      const float dx = float(x[n]) - eye_.x, dy = float(y[n]) - eye_.y, dz = float(z[n]) - eye_.z;
      const float depth = dx * ahead_.x + dy * ahead_.y + dz * ahead_.z + slack_;
      const float across = dx * right_.x + dy * right_.y + dz * right_.z;
      const float down = dx * down_.x + dy * down_.y + dz * down_.z;
      found |= int(depth > 0) & int(across + slack_ >= lo_.x * depth) & int(across - slack_ <= hi_.x * depth) &
               int(down + slack_ >= lo_.y * depth) & int(down - slack_ <= hi_.y * depth);
    }
    return found != 0;
  }

  glm::vec3 eye_, ahead_, right_, down_;
  glm::vec2 lo_, hi_;  ///< slopes
  float slack_;
};

/// Those in the box between two corners for which `wanted(i, j, pixel)` holds.
template <class Wanted>
std::vector<Picture> pictures(const PositionView& positions, const Camera& camera, glm::vec2 size, glm::vec2 a,
                              glm::vec2 b, Wanted wanted) {
  std::vector<Picture> found;
  const Projector project(camera, size);
  const Sieve sieve(camera, size, a, b);
  for (int i = 0; i < positions.rows; ++i) {
    for (int begin = 0; begin < positions.columns; begin += Sieve::block) {
      const int places = positions.rows * positions.columns - positions.absent - i * positions.columns;
      const int end = std::min({begin + Sieve::block, positions.columns, places});
      if (end <= begin) break;
      if (!sieve.any(positions, i, begin, end - begin)) continue;
      for (int j = begin; j < end; ++j) {
        const glm::dvec3 x = positions.at(i, j);
        const auto pixel = project(x);
        if (pixel && wanted(i, j, *pixel)) found.push_back({{i, j}, *pixel, project.depth(x)});
      }
    }
  }
  return found;
}

const Picture* nearest(const std::vector<Picture>& candidates, glm::vec2 pixel, float reach_px) {
  const Picture* best = nullptr;
  float best_distance = reach_px;
  for (const Picture& candidate : candidates) {
    const float distance = glm::distance(candidate.pixel, pixel);
    if (!(distance <= reach_px)) continue;
    const bool nearer = distance < best_distance - same_place_px;
    const bool before = best != nullptr && distance < best_distance + same_place_px && candidate.depth < best->depth;
    if (best == nullptr || nearer || before) best = &candidate, best_distance = distance;
  }
  return best;
}

float distance_to_segment(glm::vec2 p, glm::vec2 a, glm::vec2 b) {
  const glm::vec2 ab = b - a;
  const float squared = glm::dot(ab, ab);
  const float t = squared > 0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0f, 1.0f) : 0.0f;
  return glm::distance(p, a + t * ab);
}

}  // namespace

std::optional<Hit> nearest_particle(const PositionView& positions, const Camera& camera, glm::vec2 pixel,
                                    glm::vec2 size, float reach_px, const std::function<bool(int, int)>& skip) {
  const auto candidates = pictures(
      positions, camera, size, pixel - reach_px, pixel + reach_px,
      [&](int i, int j, glm::vec2 at) { return glm::distance(at, pixel) <= reach_px && !(skip && skip(i, j)); });
  const Picture* hit = nearest(candidates, pixel, reach_px);
  if (hit == nullptr) return std::nullopt;
  return Hit{hit->site.i, hit->site.j};
}

std::vector<Pins::Site> particles_near_path(const PositionView& positions, const Camera& camera, glm::vec2 from,
                                            glm::vec2 to, glm::vec2 size, float reach_px) {
  const auto candidates =
      pictures(positions, camera, size, glm::min(from, to) - reach_px, glm::max(from, to) + reach_px,
               [&](int, int, glm::vec2 at) { return distance_to_segment(at, from, to) <= reach_px; });
  std::vector<Pins::Site> sites;
  if (candidates.empty()) return sites;
  // Points of the way that are near beside the distances between particles, so that none in its line is passed over.
  const float apart = std::clamp(reach_px / 2, 0.5f, 2.0f);
  const int points = 1 + int(std::min(std::ceil(glm::distance(from, to) / apart), 10000.0f));
  for (int k = 0; k < points; ++k) {
    const glm::vec2 pixel = to + (from - to) * (points > 1 ? 1 - float(k) / float(points - 1) : 0.0f);
    const Picture* hit = nearest(candidates, pixel, reach_px);
    if (hit != nullptr && std::find(sites.begin(), sites.end(), hit->site) == sites.end()) sites.push_back(hit->site);
  }
  return sites;
}

std::optional<double> sphere_surface(glm::dvec3 eye, glm::dvec3 ray, glm::dvec3 center, double r) {
  const glm::dvec3 to_center = center - eye;
  const double along = glm::dot(ray, to_center), half_chord2 = r * r - (glm::dot(to_center, to_center) - along * along);
  if (along <= 0 || half_chord2 < 0) return std::nullopt;
  return along - std::sqrt(half_chord2);
}

std::optional<double> body_surface(glm::dvec3 eye, glm::dvec3 ray, const Body& body) {
  if (body.shape == Body::Shape::plane) return std::nullopt;
  if (body.shape == Body::Shape::sphere) return sphere_surface(eye, ray, body.c, body.r);
  // The distance from the surface is how far the ray can go without meeting it.
  const PlacedBody at = placed(body);
  const double end = glm::distance(eye, body.c) + at.extent, near = 1e-4 * at.extent;
  double along = 0;
  for (int n = 0; n < 200 && along < end; ++n) {
    const double gap = -depth(at, eye + along * ray);
    if (gap < near) return n > 0 ? std::optional(along) : std::nullopt;
    along += gap;
  }
  return std::nullopt;
}

std::optional<int> body_under(const std::vector<Body>& bodies, const Camera& camera, glm::vec2 pixel, glm::vec2 size) {
  const glm::dvec3 eye(camera.eye()), direction = camera.ray(pixel, size);
  std::optional<int> found;
  double nearest_distance = 0;
  for (int index = 0; index < int(bodies.size()); ++index) {
    const auto distance = body_surface(eye, direction, bodies[std::size_t(index)]);
    if (!distance || *distance <= 0 || (found && *distance >= nearest_distance)) continue;
    found = index;
    nearest_distance = *distance;
  }
  return found;
}

namespace {

/// Bodies are drawn a little inside the computed ones, so cloth that rests on one is before it.
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

  Seen look(const glm::dvec3& x) const {
    const auto pixel = project_(x);
    return pixel && std::isfinite(pixel->x) && std::isfinite(pixel->y) ? Seen{*pixel, true} : Seen{};
  }
  void look(const PositionView& positions, int i, std::vector<Seen>& row) const {
    row.resize(std::size_t(positions.columns));
    for (int j = 0; j < positions.columns; ++j) row[std::size_t(j)] = look(positions.at(i, j));
  }

  /// The way that crosses the spring between a and b; null: none does.
  const Stroke* across(const Seen& a, const Seen& b) const {
    if (!a.seen || !b.seen || far_off(a.at, b.at)) return nullptr;
    const auto found =
        std::find_if(strokes_.begin(), strokes_.end(), [&](const Stroke& stroke) { return cross(stroke, a, b); });
    return found == strokes_.end() ? nullptr : &*found;
  }

  /// Whether a body stands before the place at which the way crosses the spring between a and b.
  bool hidden(const Stroke& stroke, const Seen& a, const Seen& b, glm::dvec3 x_a, glm::dvec3 x_b) const {
    const double to_a = std::abs(side(stroke.from, stroke.to, a.at)),
                 to_b = std::abs(side(stroke.from, stroke.to, b.at));
    const glm::dvec3 at = x_a + (to_a + to_b > 0 ? to_a / (to_a + to_b) : 0.5) * (x_b - x_a);
    const double far = glm::distance(at, eye_);
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const Body& body) {
      Body drawn = body;
      drawn.r *= drawn_part, drawn.size *= drawn_part, drawn.length *= drawn_part;
      const auto surface = body_surface(eye_, (at - eye_) / far, drawn);
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
  const auto place = [&](int particle) {
    return positions.at(particle / positions.columns, particle % positions.columns);
  };
  for (const LooseSpring& spring : loose_springs(tears, 0, stretch_directions)) {
    const glm::dvec3 x_a = place(spring.a), x_b = place(spring.b);
    const Seen a = stroke_set.look(x_a), b = stroke_set.look(x_b);
    const Stroke* stroke = stroke_set.across(a, b);
    if (stroke != nullptr && !stroke_set.hidden(*stroke, a, b, x_a, x_b)) met.push_back(spring.spring);
  }
  return met;
}

}  // namespace tyglab
