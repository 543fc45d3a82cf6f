// What a first look at a preset should hold.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "app/viewport/camera.h"

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
  return p.g > 0 ? start.lo.y - 0.6f * std::max(length, width) : start.lo.y;
}

std::optional<double> plane_below(const Preset& p, double y) {
  std::optional<double> highest;
  for (const Body& body : p.bodies)
    if (body.shape == Body::Shape::plane && body.y <= y) highest = std::max(body.y, highest.value_or(body.y));
  return highest;
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
  for (const Body& body : p.bodies) {
    if (body.shape != Body::Shape::sphere) continue;
    b.add(glm::vec3(body.c) - float(body.r));
    b.add(glm::vec3(body.c) + float(body.r));
  }
  return b;
}

Camera scene_camera(const Preset& p, float aspect) {
  Camera camera;
  if (p.kind == Kind::one_weight) camera.yaw = 0, camera.pitch = 0.06f;
  const Bounds b = scene_bounds(p);
  camera.frame(b.lo, b.hi, aspect);
  return camera;
}

double ground_height(const Preset& p) {
  const Bounds b = scene_bounds(p);
  if (const auto plane = plane_below(p, b.hi.y)) return *plane;
  return b.lo.y - 0.1 * glm::length(b.hi - b.lo);
}

}  // namespace tyglab
