#include "core/contact/gap.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>

namespace tyglab {
namespace {

/// Where a line from a to b comes nearest to p, from 0 to 1.
double nearest_on_line(const glm::dvec3& p, const glm::dvec3& a, const glm::dvec3& b) {
  const glm::dvec3 ab = b - a;
  const double squared = glm::dot(ab, ab);
  return squared > 0 ? std::clamp(glm::dot(p - a, ab) / squared, 0.0, 1.0) : 0;
}

/// Shares of a triangle's corners in its point nearest to p: of its inside, or of its nearest edge.
std::array<double, 3> nearest_in_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const glm::dvec3 ab = b - a, ac = c - a, ap = p - a, normal = glm::cross(ab, ac);
  const double area = glm::dot(normal, normal);
  if (area > 0) {
    const double of_c = glm::dot(glm::cross(ab, ap), normal) / area, of_b = glm::dot(glm::cross(ap, ac), normal) / area;
    if (of_b >= 0 && of_c >= 0 && of_b + of_c <= 1) return {1 - of_b - of_c, of_b, of_c};
  }
  std::array<double, 3> best{};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < 3; ++n) {
    const glm::dvec3 &from = corners[n], &to = corners[(n + 1) % 3];
    const double t = nearest_on_line(p, from, to);
    const glm::dvec3 off = p - (from + t * (to - from));
    if (!(glm::dot(off, off) < least)) continue;
    least = glm::dot(off, off), best = {};
    best[n] = 1 - t, best[(n + 1) % 3] = t;
  }
  return best;
}

}  // namespace

Gap gap_to_triangle(const glm::dvec3& p, const std::array<glm::dvec3, 3>& triangle) {
  const auto share = nearest_in_triangle(p, triangle);
  return {{1, -share[0], -share[1], -share[2]},
          p - (share[0] * triangle[0] + share[1] * triangle[1] + share[2] * triangle[2])};
}

Gap gap_of_edges(const std::array<glm::dvec3, 2>& a, const std::array<glm::dvec3, 2>& b) {
  const glm::dvec3 u = a[1] - a[0], v = b[1] - b[0], w = a[0] - b[0];
  const double uu = glm::dot(u, u), uv = glm::dot(u, v), vv = glm::dot(v, v), uw = glm::dot(u, w), vw = glm::dot(v, w);
  // The nearest points of the two lines, then the nearest ones within the edges.
  const double square = uu * vv - uv * uv;
  double s = square > 0 ? std::clamp((uv * vw - vv * uw) / square, 0.0, 1.0) : 0;
  double t = vv > 0 ? (uv * s + vw) / vv : 0;
  if (!(t >= 0 && t <= 1)) {
    t = t > 1 ? 1 : 0;
    s = uu > 0 ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0;
  }
  return {{1 - s, s, t - 1, -t}, w + s * u - t * v, true};
}

}  // namespace tyglab
