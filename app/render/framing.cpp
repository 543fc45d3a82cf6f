// Frames the whole scene when a preset is opened, and later the cloth at its present place.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "app/render/camera.h"
#include "core/forces/contact.h"

namespace tyglab {
namespace {

glm::vec3 start_corner(const Preset& p, int i, int j) {
  const double theta = p.tilt_deg * std::numbers::pi / 180;
  const glm::dvec3 along_row((j - (p.columns - 1) / 2.0) * p.L, 0, 0);
  const glm::dvec3 down = i * p.L * glm::dvec3(0, -std::sin(theta), std::cos(theta));
  return glm::vec3(p.x_0 + p.initial_stretch * (along_row + down));
}

Bounds start_bounds(const Preset& p) {
  Bounds b;
  for (int i : {0, p.rows - 1})
    for (int j : {0, p.columns - 1}) b.add(start_corner(p, i, j));
  return b;
}

bool hangs_from_top(const Pins& pins) {
  const auto in_top_row = [](const Pins::Site& site) { return site.i == 0; };
  return pins.mode == Pins::Mode::top_row || pins.mode == Pins::Mode::top_corners ||
         (pins.mode == Pins::Mode::list && !pins.list.empty() &&
          std::all_of(pins.list.begin(), pins.list.end(), in_top_row));
}

std::optional<double> plane_below(const Preset& p, double y) {
  std::optional<double> highest;
  for (const Body& body : p.bodies)
    if (body.shape == Body::Shape::plane && body.turn == glm::dvec3(0) && body.y <= y)
      highest = std::max(body.y, highest.value_or(body.y));
  return highest;
}

/// The height to which the cloth will come down, roughly.
float lowest_hanging(const Preset& p, const Bounds& start) {
  const float length = float((p.rows - 1) * p.L), width = float((p.columns - 1) * p.L);
  if (hangs_from_top(p.pins)) return std::min(start.lo.y, start.hi.y - 1.08f * length);
  switch (p.pins.mode) {
    case Pins::Mode::left_column:
      return start.lo.y - 0.25f * width;
    case Pins::Mode::boundary:
      return start.lo.y - 0.2f * std::max(length, width);
    case Pins::Mode::four_corners:
      return start.lo.y - 0.42f * std::max(length, width);
    case Pins::Mode::list:
      return start.lo.y - 0.5f * std::min(length, width);
    default:
      break;
  }
  if (!(p.g > 0)) return start.lo.y;
  const float size = std::max(length, width), near = 1.4f * size;
  // What nothing holds falls as far as a plane, where that is near enough to be seen with the cloth.
  const auto plane = plane_below(p, start.lo.y);
  return plane && start.lo.y - *plane < near ? float(*plane) : start.lo.y - 0.6f * size;
}

}  // namespace

std::optional<Bounds> body_bounds(const Body& body, const Bounds& cloth) {
  using Shape = Body::Shape;
  if (body.shape == Shape::plane) return std::nullopt;
  const PlacedBody at = placed(body);
  glm::vec3 half(float(body.r));
  for (int k = 0; k < 3 && body.shape != Shape::sphere; ++k)
    half[k] = body.shape == Shape::box
                  ? float(std::abs(at.axes[k]) * at.size[0] + std::abs(at.axes[3 + k]) * at.size[1] +
                          std::abs(at.axes[6 + k]) * at.size[2])
                  : float(body.r + std::abs(at.axes[3 + k]) * body.length / 2);
  const glm::vec3 c(at.c[0], at.c[1], at.c[2]);
  Bounds box{c - half, c + half};
  // Of a table as large as a hall the part at the cloth is looked at.
  if (body.shape == Shape::sphere || cloth.empty()) return box;
  const glm::vec3 around(glm::length(cloth.hi - cloth.lo));
  box.lo = glm::max(box.lo, cloth.lo - around), box.hi = glm::min(box.hi, cloth.hi + around);
  if (glm::any(glm::lessThan(box.hi, box.lo))) return std::nullopt;
  return box;
}

namespace {

std::vector<glm::vec3> start_points(const Preset& p) {
  std::vector<glm::vec3> points;
  for (int i : {0, p.rows - 1})
    for (int j : {0, p.columns - 1}) points.push_back(start_corner(p, i, j));
  return points;
}

void add_corners(std::vector<glm::vec3>& points, const Bounds& b) {
  for (int k = 0; k < 8; ++k)
    points.emplace_back(k & 1 ? b.hi.x : b.lo.x, k & 2 ? b.hi.y : b.lo.y, k & 4 ? b.hi.z : b.lo.z);
}

/// How far the end of a cloth sinks that reaches `reach` beyond its pins, m. With a rigidity B it bends like a clamped
/// strip, of which only G = weight · reach³/B counts.
float sinks(const Preset& p, double reach) {
  constexpr double limp = 0.97, small_bends = 8;  // a beam sinks by G/8 of its length
  const double G_by_B = p.m * p.g * reach * reach * reach / (p.L * p.L);
  const double part = p.B > 0 && p.g > 0 ? 1.25 * G_by_B / (G_by_B + small_bends * p.B) : limp;
  return float(std::min(part, limp) * reach);
}

/// Of the pins of a list, where the corners come to hang: below the nearest pin.
void add_hanging_corners(std::vector<glm::vec3>& points, const Preset& p) {
  for (int i : {0, p.rows - 1}) {
    for (int j : {0, p.columns - 1}) {
      const auto distance = [&](const Pins::Site& s) { return std::hypot(double(s.i - i), double(s.j - j)); };
      const auto pin = std::min_element(p.pins.list.begin(), p.pins.list.end(),
                                        [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
      const glm::vec3 from = start_corner(p, pin->i, pin->j);
      points.push_back(from);
      points.emplace_back(from.x, from.y - sinks(p, distance(*pin) * p.L), from.z);
    }
  }
}

/// Where cloth that hangs from its top edge comes to rest, with as much swing as it had at the start.
void add_hanging_sheet(std::vector<glm::vec3>& points, const Preset& p, const Bounds& start) {
  const float bottom = lowest_hanging(p, start), swing = 0.2f * (start.hi.z - start.lo.z);
  for (int j : {0, p.columns - 1}) {
    const glm::vec3 top = start_corner(p, 0, j);
    points.push_back(top);
    for (const float z : {top.z - swing, top.z + swing}) points.emplace_back(top.x, bottom, z);
  }
}

/// How far paths lead pins away.
Bounds way_bounds(const Preset& p) {
  Bounds way;
  way.add(glm::vec3(0));
  for (const Pins::Motion& motion : p.pins.motions)
    for (const PathKey& key : motion.path) way.add(glm::vec3(key.x - on_path(motion.path, 0)));
  return way;
}

/// Where free cloth passes that a body carries round as it spins about a vertical axis.
void add_carried_corners(std::vector<glm::vec3>& points, const Preset& p, const Body& body) {
  constexpr int sides = 12;
  constexpr double draped = 0.9;  // of the farthest corner's distance while it lay flat
  double reach = 0;
  for (const glm::vec3& corner : start_points(p))
    reach = std::max(reach, std::hypot(corner.x - body.c.x, corner.z - body.c.z));
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    points.emplace_back(body.c + draped * reach * glm::dvec3(std::cos(angle), 0, std::sin(angle)));
  }
}

/// Corners of what is seen once the start is over: where the cloth will be, roughly, and the spheres.
std::vector<glm::vec3> lasting_points(const Preset& p) {
  std::vector<glm::vec3> points;
  Bounds spheres;
  const Bounds start = start_bounds(p);
  for (const Body& body : p.bodies)
    if (const auto box = body_bounds(body, start)) {
      // A draped cloth stands off from its body.
      const glm::vec3 more = 0.05f * (box->hi - box->lo);
      spheres.add(box->lo - more), spheres.add(box->hi + more);
      if (p.pins.mode == Pins::Mode::none && body.spin.y != 0) add_carried_corners(points, p, body);
    }
  if (!spheres.empty()) add_corners(points, spheres);
  if (hangs_from_top(p.pins)) {
    add_hanging_sheet(points, p, start);
  } else if (p.pins.mode == Pins::Mode::list && !p.pins.list.empty()) {
    add_hanging_corners(points, p);
  } else if (p.pins.mode == Pins::Mode::four_corners || p.pins.mode == Pins::Mode::boundary) {
    points = start_points(p);
    const glm::vec3 middle = (start.lo + start.hi) / 2.0f;
    // The edges sag too; the near one would be the first to leave the picture. What tears off its pins hangs down.
    const float torn = p.F_max > 0 ? 0.6f * std::max(start.hi.x - start.lo.x, start.hi.z - start.lo.z) : 0;
    const float bottom = std::min(lowest_hanging(p, start), start.lo.y - torn);
    for (const float z : {middle.z, start.hi.z}) points.emplace_back(middle.x, bottom, z);
  } else if (p.pins.mode != Pins::Mode::none || spheres.empty()) {
    Bounds box = scene_bounds(p);
    if (p.pins.mode == Pins::Mode::left_column) box.hi.y += 0.15f * (box.hi.x - box.lo.x);  // it flies up at first
    add_corners(points, box);
  }
  if (const auto plane = plane_below(p, start.hi.y))
    for (glm::vec3& point : points) point.y = std::max(point.y, float(*plane));
  if (const Bounds way = way_bounds(p); way.lo != way.hi) {
    std::vector<glm::vec3> ways;
    add_corners(ways, way);
    for (const glm::vec3& point : std::exchange(points, {}))
      for (const glm::vec3& by : ways) points.push_back(point + by);
  }
  return points;
}

Bounds weight_bounds(const Preset& p) {
  const double sag = p.k > 0 ? p.m * p.g / p.k : 0;
  const double reach = std::clamp(std::max(std::abs(p.offset), std::abs(sag)), 0.02, 1e3);
  Bounds b;
  b.add(glm::vec3(p.x_0) + glm::vec3(-1.2 * reach, -sag - 1.6 * reach, -0.3 * reach));
  b.add(glm::vec3(p.x_0) + glm::vec3(1.2 * reach, 3.2 * reach, 0.3 * reach));
  return b;
}

}  // namespace

void Bounds::add(glm::vec3 point) {
  lo = glm::min(lo, point);
  hi = glm::max(hi, point);
}

void Bounds::add(const Bounds& other) {
  if (other.empty()) return;
  add(other.lo);
  add(other.hi);
}

Bounds bounds(const PositionView& positions) {
  Bounds b;
  for (int i = 0; i < positions.rows; ++i) {
    for (int j = 0; j < positions.columns; ++j) {
      const glm::vec3 x(positions.at(i, j));
      if (std::isfinite(x.x) && std::isfinite(x.y) && std::isfinite(x.z)) b.add(x);
    }
  }
  return b;
}

Bounds scene_bounds(const Preset& p) {
  if (p.kind == Kind::one_weight) return weight_bounds(p);
  Bounds b = start_bounds(p);
  b.lo.y = lowest_hanging(p, b);
  if (const auto plane = plane_below(p, b.hi.y)) b.lo.y = std::max(b.lo.y, float(*plane));
  // A slanted sheet swings through: leave it as much room behind its top edge as it has before it.
  if (hangs_from_top(p.pins)) b.lo.z -= 0.35f * (b.hi.z - b.lo.z);
  const Bounds cloth = b, way = way_bounds(p);
  b.lo += way.lo, b.hi += way.hi;
  for (const Body& body : p.bodies)
    if (const auto box = body_bounds(body, cloth)) b.add(box->lo), b.add(box->hi);
  return b;
}

Camera scene_camera(const Preset& p, float aspect, float covered, float below, float filled) {
  Camera camera;
  if (p.kind == Kind::one_weight) {
    camera.yaw = 0, camera.pitch = 0.06f;
    const Bounds b = scene_bounds(p);
    camera.frame(b.lo, b.hi, aspect);
    return camera;
  }
  // A cloth that lies flat is seen from higher up, or it would be but a line.
  const double flatness = std::abs(std::cos(p.tilt_deg * std::numbers::pi / 180));
  if (flatness > 0.9) camera.pitch = 0.3f;
  // The start, which is left at once, may come nearer to the edges than what is looked at for long.
  std::vector<glm::vec3> seen = start_points(p);
  const std::vector<glm::vec3> lasting = lasting_points(p);
  seen.insert(seen.end(), lasting.begin(), lasting.end());
  camera.frame(seen, aspect, {0.98f, std::max(0.92f, filled)}, covered, below);
  camera.make_room(lasting, aspect, filled, covered, below);
  return camera;
}

float PicturePart::in_sight() const {
  const auto along = [](float from, float to) {
    const float common = std::min(to, 1.f) - std::max(from, 0.f), size = std::min(to - from, 1.f);
    return common < 0 ? 0 : size > 0 ? common / size : 1;
  };
  return along(lo.x, hi.x) * along(lo.y, hi.y);
}

std::optional<PicturePart> part_of_picture(const Camera& camera, const Bounds& box, float aspect) {
  const Projector project(camera, {aspect, 1});
  std::vector<glm::vec3> corners;
  add_corners(corners, box);
  PicturePart part{glm::vec2(1e30f), glm::vec2(-1e30f)};
  std::size_t before = 0;
  for (const glm::vec3& corner : corners)
    if (const auto at = project(glm::dvec3(corner))) {
      const glm::vec2 there = *at / glm::vec2(aspect, 1);
      part.lo = glm::min(part.lo, there), part.hi = glm::max(part.hi, there), ++before;
    }
  if (before == 0) return std::nullopt;
  return before == corners.size() ? part : PicturePart{glm::vec2(0), glm::vec2(1)};
}

Camera present_camera(const Preset& p, Bounds cloth, float aspect, float covered, float below, float filled) {
  constexpr float large_enough = 0.45f, near_enough = 0.15f, slack = 0.02f;
  Camera camera = scene_camera(p, aspect, covered, below, filled);
  if (cloth.empty()) return camera;
  if (p.kind == Kind::one_weight) cloth.add(weight_bounds(p));
  if (const auto part = part_of_picture(camera, cloth, aspect)) {
    const glm::vec2 from(0, covered), free(1, 1 - covered - below);  // of the picture
    const glm::vec2 lo = (part->lo - from) / free, hi = (part->hi - from) / free, off = glm::abs(lo + hi - 1.f) / 2.f;
    if (std::min(lo.x, lo.y) > -slack && std::max(hi.x, hi.y) < 1 + slack && std::max(off.x, off.y) < near_enough &&
        std::max(hi.x - lo.x, hi.y - lo.y) > large_enough)
      return camera;
  }
  const glm::vec3 size = cloth.hi - cloth.lo, reach = glm::vec3(glm::length(size) / 2);
  std::vector<glm::vec3> seen;
  add_corners(seen, cloth);
  for (const Body& body : p.bodies)
    if (const auto box = body_bounds(body, cloth);
        box && glm::all(glm::lessThan(box->lo, cloth.hi + reach)) && glm::all(glm::lessThan(cloth.lo - reach, box->hi)))
      add_corners(seen, *box);
  if (size.y < 0.2f * std::max(size.x, size.z)) camera.pitch = 0.45f;  // it lies flat
  camera.frame(seen, aspect, glm::vec2(filled), covered, below);
  return camera;
}

std::optional<double> floor_height(const Preset& p) {
  return plane_below(p, scene_bounds(p).hi.y);
}

double ground_height(const Preset& p) {
  if (const auto plane = floor_height(p)) return *plane;
  const Bounds b = scene_bounds(p);
  return b.lo.y - 0.1 * glm::length(b.hi - b.lo);
}

}  // namespace tyglab
