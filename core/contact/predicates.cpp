#include "core/contact/predicates.h"

#include <cmath>
#include <limits>

#include "core/contact/exact_number.h"

namespace tyglab {
namespace {

/// Half a unit in the last place of 1: the largest relative error of one rounding.
constexpr double rounding = std::numeric_limits<double>::epsilon() / 2;
/// More than what products lose by underflow, a part of it for each unit of what they are multiplied by next.
constexpr double underflow = 1e-300;

int sign_of(double value) {
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

ExactNumber difference(double a, double b) {
  return ExactNumber(a) - ExactNumber(b);
}

/// The differences from d, coordinate by coordinate.
struct ExactDifference {
  ExactNumber x, y, z;
  ExactDifference(const glm::dvec3& a, const glm::dvec3& d)
      : x(difference(a.x, d.x)), y(difference(a.y, d.y)), z(difference(a.z, d.z)) {}
};

int exact_orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const ExactDifference u(a, d), v(b, d), w(c, d);
  const auto minor = [](const ExactDifference& p, const ExactDifference& q) { return p.x * q.y - q.x * p.y; };
  return (u.z * minor(v, w) + v.z * minor(w, u) + w.z * minor(u, v)).sign();
}

/// Whether the points lie in a plane of one coordinate.
bool in_level_plane(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const auto level = [&](int n) { return a[n] == d[n] && b[n] == d[n] && c[n] == d[n]; };
  return level(0) || level(1) || level(2);
}

}  // namespace

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  const glm::dvec3 u = a - d, v = b - d, w = c - d;
  const double vw = v.x * w.y, wv = w.x * v.y, wu = w.x * u.y, uw = u.x * w.y, uv = u.x * v.y, vu = v.x * u.y;
  const double volume = u.z * (vw - wv) + v.z * (wu - uw) + w.z * (uv - vu);
  const double up = std::abs(u.z), vp = std::abs(v.z), wp = std::abs(w.z);
  const double largest =
      up * (std::abs(vw) + std::abs(wv)) + vp * (std::abs(wu) + std::abs(uw)) + wp * (std::abs(uv) + std::abs(vu));
  // (7 + 56ε)ε is Shewchuk's bound.
  const double bound = 8 * rounding * largest + underflow * (1 + up + vp + wp);
  if (std::abs(volume) > bound) return sign_of(volume);
  return in_level_plane(a, b, c, d) ? 0 : exact_orientation(a, b, c, d);
}

int orientation(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, int dropped) {
  const int s = (dropped + 1) % 3, t = (dropped + 2) % 3;
  const double left = (a[s] - c[s]) * (b[t] - c[t]), right = (a[t] - c[t]) * (b[s] - c[s]);
  const double area = left - right;
  // (3 + 16ε)ε is Shewchuk's bound.
  if (std::abs(area) > 4 * rounding * (std::abs(left) + std::abs(right)) + underflow) return sign_of(area);
  if ((a[s] == c[s] && b[s] == c[s]) || (a[t] == c[t] && b[t] == c[t])) return 0;
  return (difference(a[s], c[s]) * difference(b[t], c[t]) - difference(a[t], c[t]) * difference(b[s], c[s])).sign();
}

}  // namespace tyglab
