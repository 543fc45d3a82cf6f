#include "app/render/picking.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

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
      const int end = std::min(begin + Sieve::block, positions.columns);
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

std::optional<int> body_under(const std::vector<Body>& bodies, const Camera& camera, glm::vec2 pixel, glm::vec2 size) {
  const glm::dvec3 eye(camera.eye()), direction = camera.ray(pixel, size);
  std::optional<int> found;
  double nearest_distance = 0;
  for (int index = 0; index < int(bodies.size()); ++index) {
    const Body& body = bodies[index];
    if (body.shape != Body::Shape::sphere) continue;
    const auto distance = sphere_surface(eye, direction, body.c, body.r);
    if (!distance || *distance <= 0 || (found && *distance >= nearest_distance)) continue;
    found = index;
    nearest_distance = *distance;
  }
  return found;
}

}  // namespace tyglab
