#include "core/contact/triangle_pair.h"

#include <algorithm>
#include <cassert>

#include "core/contact/predicates.h"

// Points of one plane are looked at along the three axes: along at least one of them no two points of the plane, nor of
// a line, fall together. So sets in one plane meet exactly if all three of their pictures do.

namespace tyglab {
namespace {

using Point = glm::dvec3;

template <class Meets>
bool along_all_axes(Meets meets) {
  return meets(0) && meets(1) && meets(2);
}

/// The functions with `dropped` leave that coordinate out.
bool on_segment(const Point& x, const Point& p, const Point& q, int dropped) {
  for (const int n : {(dropped + 1) % 3, (dropped + 2) % 3})
    if (x[n] < std::min(p[n], q[n]) || x[n] > std::max(p[n], q[n])) return false;
  return orientation(x, p, q, dropped) == 0;
}

bool on_segment(const Point& x, const Point& p, const Point& q) {
  return along_all_axes([&](int dropped) { return on_segment(x, p, q, dropped); });
}

bool segments_meet(const Point& p, const Point& q, const Point& a, const Point& b, int dropped) {
  if (on_segment(p, a, b, dropped) || on_segment(q, a, b, dropped)) return true;
  if (on_segment(a, p, q, dropped) || on_segment(b, p, q, dropped)) return true;
  return orientation(p, q, a, dropped) * orientation(p, q, b, dropped) < 0 &&
         orientation(a, b, p, dropped) * orientation(a, b, q, dropped) < 0;
}

bool segments_meet(const Point& p, const Point& q, const Point& a, const Point& b) {
  return orientation(p, q, a, b) == 0 &&
         along_all_axes([&](int dropped) { return segments_meet(p, q, a, b, dropped); });
}

bool in_triangle(const Point& x, const Triangle& t, int dropped) {
  if (const int turn = orientation(t[0], t[1], t[2], dropped); turn != 0)
    return turn * orientation(t[0], t[1], x, dropped) >= 0 && turn * orientation(t[1], t[2], x, dropped) >= 0 &&
           turn * orientation(t[2], t[0], x, dropped) >= 0;
  return on_segment(x, t[0], t[1], dropped) || on_segment(x, t[1], t[2], dropped) || on_segment(x, t[2], t[0], dropped);
}

/// For a point in the triangle's plane.
bool in_triangle(const Point& x, const Triangle& t) {
  return along_all_axes([&](int dropped) { return in_triangle(x, t, dropped); });
}

/// Whether the corners lie on one line.
bool is_flat(const Triangle& t) {
  return along_all_axes([&](int dropped) { return orientation(t[0], t[1], t[2], dropped) == 0; });
}

/// On which sides of a triangle's plane the corners of another one are.
using Sides = std::array<int, 3>;

Sides sides_of(const Triangle& t, const Triangle& plane, int shared) {
  Sides sides{};
  for (int n = shared; n < 3; ++n) sides[n] = orientation(plane[0], plane[1], plane[2], t[n]);
  return sides;
}

/// Whether all corners but the shared one are strictly on one side.
bool all_on_one_side(const Sides& sides, int shared) {
  return sides[2] != 0 && std::all_of(sides.begin() + shared, sides.end(), [&](int s) { return s == sides[2]; });
}

/// Whether the edge from corner n of a triangle with these sides meets t.
bool edge_meets(const Triangle& of, const Sides& sides, int n, const Triangle& t) {
  const int m = (n + 1) % 3;
  const Point &p = of[n], &q = of[m];
  if (sides[n] * sides[m] > 0) return false;
  if (sides[n] == 0 && sides[m] == 0)
    return in_triangle(p, t) || in_triangle(q, t) || segments_meet(p, q, t[0], t[1]) ||
           segments_meet(p, q, t[1], t[2]) || segments_meet(p, q, t[2], t[0]);
  // The line meets the plane in one point: inside if it passes all edges on one side.
  const int first = orientation(p, q, t[0], t[1]), second = orientation(p, q, t[1], t[2]);
  if (first * second < 0) return false;
  const int third = orientation(p, q, t[2], t[0]);
  return first * third >= 0 && second * third >= 0;
}

/// Whether corner n of a triangle with these sides lies in t.
bool corner_in(const Triangle& of, const Sides& sides, int n, const Triangle& t) {
  return sides[n] == 0 && in_triangle(of[n], t);
}

/// Triangles in one plane that share an edge: whether one is folded onto the other.
bool folded(const Triangle& a, const Triangle& b) {
  if (is_flat(a) || is_flat(b)) {
    const auto reaches = [&](const Triangle& of, const Triangle& t) {
      return in_triangle(of[2], t) && !on_segment(of[2], of[0], of[1]);
    };
    return reaches(a, b) || reaches(b, a);
  }
  return along_all_axes(
      [&](int dropped) { return orientation(a[0], a[1], a[2], dropped) == orientation(a[0], a[1], b[2], dropped); });
}

/// Triangles that share corner 0. They are convex, so a common point beside it lies on a line from there on which the
/// last common point is one of an edge opposite to it or, of triangles without area, a corner.
bool cross_beside_corner(const Triangle& a, const Sides& of_a, const Triangle& b, const Sides& of_b) {
  const auto reaches = [](const Triangle& t, const Sides& sides, const Triangle& other) {
    for (const int n : {1, 2})
      if (t[n] != t[0] && corner_in(t, sides, n, other)) return true;
    return edge_meets(t, sides, 1, other) && !on_segment(t[0], t[1], t[2]);
  };
  return reaches(a, of_a, b) || reaches(b, of_b, a);
}

}  // namespace

bool triangles_cross(const Triangle& a, const Triangle& b, int shared) {
  assert(shared >= 0 && shared <= 2);
  const Sides of_a = sides_of(a, b, shared);
  if (shared == 2) return of_a[2] == 0 && folded(a, b);
  if (all_on_one_side(of_a, shared)) return false;
  const Sides of_b = sides_of(b, a, shared);
  if (all_on_one_side(of_b, shared)) return false;
  if (shared == 1) return cross_beside_corner(a, of_a, b, of_b);
  for (int n = 0; n < 3; ++n)
    if (edge_meets(a, of_a, n, b) || edge_meets(b, of_b, n, a)) return true;
  return false;
}

}  // namespace tyglab
