// Pairs of triangles against an independent rule in exact integers: one triangle is clipped by the half spaces whose
// intersection the other one is, and a corner of what is left must not be of the part that both share.
#include "core/contact/triangle_pair.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>

#include "core/contact/predicates.h"
#include "tests/support/scenes.h"

namespace tyglab::triangle_pair_test {

using Integer = boost::multiprecision::cpp_int;

struct Vector {
  Integer x, y, z;
};
Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
Vector operator-(const Vector& a) {
  return {-a.x, -a.y, -a.z};
}
Integer dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
bool is_zero(const Vector& a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}

/// The point v / weight, with a weight above 0.
struct Homogeneous {
  Vector v;
  Integer weight = 1;
};

/// The points p with normal·p >= least.
struct HalfSpace {
  Vector normal;
  Integer least;
};
Integer excess(const HalfSpace& space, const Homogeneous& p) {
  return dot(space.normal, p.v) - space.least * p.weight;
}

using Polygon = std::vector<Homogeneous>;

/// Sutherland and Hodgman's step. The polygon may have no area.
Polygon clipped(const Polygon& polygon, const HalfSpace& space) {
  Polygon left;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Homogeneous &p = polygon[n], &q = polygon[(n + 1) % polygon.size()];
    const Integer at_p = excess(space, p), at_q = excess(space, q);
    if (at_p >= 0) left.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
      const Integer of_q = abs(at_p), of_p = abs(at_q);
      left.push_back({{of_p * p.v.x + of_q * q.v.x, of_p * p.v.y + of_q * q.v.y, of_p * p.v.z + of_q * q.v.z},
                      of_p * p.weight + of_q * q.weight});
    }
  }
  return left;
}

using Corners = std::vector<Vector>;

HalfSpace beyond(const Vector& normal, const Vector& point) {
  return {normal, dot(normal, point)};
}

/// A convex set whose points satisfy normal·p = normal·point.
void add_plane(std::vector<HalfSpace>& spaces, const Vector& normal, const Vector& point) {
  spaces.push_back(beyond(normal, point)), spaces.push_back(beyond(-normal, point));
}

/// Half spaces that have the segment, which may be a point, in common.
std::vector<HalfSpace> segment_spaces(const Vector& p, const Vector& q) {
  std::vector<HalfSpace> spaces;
  const Vector along = q - p;
  const Vector axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Vector& axis : axes) add_plane(spaces, is_zero(along) ? axis : cross(along, axis), p);
  if (!is_zero(along)) spaces.push_back(beyond(along, p)), spaces.push_back(beyond(-along, q));
  return spaces;
}

/// The same for the convex hull of up to three points.
std::vector<HalfSpace> spaces_of(const Corners& c) {
  if (c.size() == 1) return segment_spaces(c[0], c[0]);
  if (c.size() == 2) return segment_spaces(c[0], c[1]);
  const Vector normal = cross(c[1] - c[0], c[2] - c[0]);
  if (is_zero(normal)) {
    // The longest of the three sides.
    const auto length = [&](int n) { return dot(c[(n + 1) % 3] - c[n], c[(n + 1) % 3] - c[n]); };
    const int longest = length(0) >= length(1) && length(0) >= length(2) ? 0 : length(1) >= length(2) ? 1 : 2;
    return segment_spaces(c[longest], c[(longest + 1) % 3]);
  }
  std::vector<HalfSpace> spaces;
  add_plane(spaces, normal, c[0]);
  for (int n = 0; n < 3; ++n) spaces.push_back(beyond(cross(normal, c[(n + 1) % 3] - c[n]), c[n]));
  return spaces;
}

bool expected(const Corners& a, const Corners& b, int shared) {
  Polygon common;
  for (const Vector& corner : a) common.push_back({corner, 1});
  for (const HalfSpace& space : spaces_of(b)) common = clipped(common, space);
  if (shared == 0) return !common.empty();
  const std::vector<HalfSpace> spaces = spaces_of({a.begin(), a.begin() + shared});
  return std::any_of(common.begin(), common.end(), [&](const Homogeneous& p) {
    return std::any_of(spaces.begin(), spaces.end(), [&](const HalfSpace& space) { return excess(space, p) < 0; });
  });
}

/// Whole numbers that doubles hold exactly.
using Whole = std::array<std::array<std::int64_t, 3>, 3>;

Corners exact(const Whole& t) {
  Corners corners;
  for (const auto& c : t) corners.push_back({c[0], c[1], c[2]});
  return corners;
}
Triangle rounded(const Whole& t, double unit) {
  Triangle triangle;
  for (std::size_t n = 0; n < 3; ++n)
    triangle[n] = {double(t[n][0]) * unit, double(t[n][1]) * unit, double(t[n][2]) * unit};
  return triangle;
}

/// What a family of random pairs came to.
struct Tally {
  int pairs = 0, crossing = 0, wrong = 0;
};

/// Compares pairs with corners from `coordinate`, a third each without a shared corner, with one, and with two.
template <class Coordinate>
Tally compared(int pairs, double unit, Coordinate coordinate) {
  Tally tally;
  for (int n = 0; n < pairs; ++n) {
    const int shared = n % 3;
    Whole a, b;
    for (Whole* t : {&a, &b})
      for (auto& corner : *t)
        for (std::int64_t& value : corner) value = coordinate();
    std::copy_n(a.begin(), shared, b.begin());
    const bool crossing = expected(exact(a), exact(b), shared);
    const Triangle of_a = rounded(a, unit), of_b = rounded(b, unit);
    const bool right =
        triangles_cross(of_a, of_b, shared) == crossing && triangles_cross(of_b, of_a, shared) == crossing;
    ++tally.pairs, tally.crossing += crossing ? 1 : 0, tally.wrong += right ? 0 : 1;
  }
  return tally;
}

void check(const Tally& tally, double least_share) {
  CHECK(tally.wrong == 0);
  CHECK(tally.crossing > least_share * tally.pairs);
  CHECK(tally.crossing < (1 - least_share) * tally.pairs);
}

TEST_CASE("pairs of triangles cross exactly where exact integers say so") {
  test::Random random(20);
  const auto up_to = [&](int most) { return std::int64_t(random.below(most + 1)); };
  // On the smallest grids most pairs touch, lie in one plane or have no area.
  check(compared(30000, 1, [&] { return up_to(1); }), 0.05);
  check(compared(40000, 0.25, [&] { return up_to(2); }), 0.05);
  check(compared(20000, 1e3, [&] { return up_to(4); }), 0.05);
  check(compared(10000, 1, [&] { return up_to(1 << 20); }), 0.05);
  // A grid of which each point is moved by a unit in the last place: only exact arithmetic can decide.
  check(compared(20000, 0x1p-40, [&] { return (up_to(2) << 50) + up_to(2) - 1; }), 0.05);
}

TEST_CASE("pairs of triangles in one plane, level or inclined") {
  test::Random random(21);
  const auto up_to = [&](int most) { return std::int64_t(random.below(most + 1)); };
  const auto in_plane = [&](std::int64_t slope) {
    std::array<std::int64_t, 3> next{};
    std::size_t at = 3;
    return compared(10000, 0.125, [&, next, at]() mutable {
      if (at == 3) {
        next[0] = up_to(3), next[1] = up_to(3), next[2] = slope * (next[0] + 2 * next[1]);
        at = 0;
      }
      return next[at++];
    });
  };
  check(in_plane(0), 0.05);
  check(in_plane(1), 0.05);
}

TEST_CASE("signs where products of floating point numbers underflow or overflow") {
  for (const double unit : {1e-200, 1e-320, 1e200}) {
    const glm::dvec3 o(0, 0, 0), x(unit, 0, 0), y(0, unit, 0), z(0, 0, unit);
    CHECK(orientation(x, y, z, o) == 1);
    CHECK(orientation(y, x, z, o) == -1);
    CHECK(orientation(x, y, o, 2) == 1);
    CHECK(orientation(x, y, x + y, o) == 0);
  }
  // Two products of 0.6 and 1.4 times the least number, which are both rounded to it.
  const double small = 0x1p-537;
  CHECK(orientation(glm::dvec3{-0.6 * small, 0, 2}, {-1.4 * small, 0, 3}, {0, small, 0}, {0, 0, 0}) == -1);
  // One denormal number from a plane in which the numbers are of ordinary size.
  const double least = 5e-324;
  CHECK(orientation(glm::dvec3{1, 0, 0}, {0, 1, 0}, {1, 1, least}, {0.25, 0.25, 0}) == 1);
  CHECK(orientation(glm::dvec3{1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.25, 0.25, -least}) == -1);
}

}  // namespace tyglab::triangle_pair_test
