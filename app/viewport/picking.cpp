#include "app/viewport/picking.h"

#include <algorithm>
#include <cmath>
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

template <class Wanted>
std::vector<Picture> pictures(const PositionView& positions, const Camera& camera, glm::vec2 size, Wanted wanted) {
  std::vector<Picture> found;
  const Projector project(camera, size);
  for (int i = 0; i < positions.rows; ++i) {
    for (int j = 0; j < positions.columns; ++j) {
      const glm::dvec3 x = positions.at(i, j);
      const auto pixel = project(x);
      if (pixel && wanted(i, j, *pixel)) found.push_back({{i, j}, *pixel, project.depth(x)});
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
  const auto candidates = pictures(positions, camera, size, [&](int i, int j, glm::vec2 at) {
    return glm::distance(at, pixel) <= reach_px && !(skip && skip(i, j));
  });
  const Picture* hit = nearest(candidates, pixel, reach_px);
  if (hit == nullptr) return std::nullopt;
  return Hit{hit->site.i, hit->site.j, glm::distance(hit->pixel, pixel)};
}

std::vector<Pins::Site> particles_near_path(const PositionView& positions, const Camera& camera, glm::vec2 from,
                                            glm::vec2 to, glm::vec2 size, float reach_px) {
  const auto candidates = pictures(
      positions, camera, size, [&](int, int, glm::vec2 at) { return distance_to_segment(at, from, to) <= reach_px; });
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

std::optional<int> body_under(const std::vector<Body>& bodies, const Camera& camera, glm::vec2 pixel, glm::vec2 size) {
  const glm::dvec3 eye(camera.eye()), direction = camera.ray(pixel, size);
  std::optional<int> found;
  double nearest_distance = 0;
  for (int index = 0; index < int(bodies.size()); ++index) {
    const Body& body = bodies[index];
    if (body.shape != Body::Shape::sphere) continue;
    const glm::dvec3 to_eye = eye - body.c;
    const double b = glm::dot(to_eye, direction), c = glm::dot(to_eye, to_eye) - body.r * body.r;
    const double discriminant = b * b - c;
    if (discriminant < 0) continue;
    const double distance = -b - std::sqrt(discriminant);
    if (distance <= 0 || (found && distance >= nearest_distance)) continue;
    found = index;
    nearest_distance = distance;
  }
  return found;
}

}  // namespace tyglab
