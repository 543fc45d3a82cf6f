#include "app/render/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace tyglab {
namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float largest_pitch = 85 * pi / 180;
constexpr float radians_per_pixel = pi / 600;

}  // namespace

glm::vec3 Camera::forward() const {
  return -glm::vec3(std::sin(yaw) * std::cos(pitch), std::sin(pitch), std::cos(yaw) * std::cos(pitch));
}
glm::vec3 Camera::eye() const {
  return target - distance * forward();
}
glm::vec3 Camera::right() const {
  return {std::cos(yaw), 0, -std::sin(yaw)};
}
glm::vec3 Camera::up() const {
  return glm::cross(right(), forward());
}

glm::mat4 Camera::view() const {
  return glm::lookAt(eye(), target, glm::vec3(0, 1, 0));
}

glm::mat4 Camera::projection(float aspect) const {
  // What limits the depth buffer is the near plane; the far one may lie far behind whatever is looked at.
  return glm::perspective(fov_y, aspect, 0.01f * distance, 100 * distance + 200);
}

void Camera::orbit(float dx, float dy) {
  yaw = std::remainder(yaw - dx * radians_per_pixel, 2 * pi);
  pitch = std::clamp(pitch + dy * radians_per_pixel, -largest_pitch, largest_pitch);
}

void Camera::pan(float dx, float dy, float viewport_height) {
  const auto of_pixel = float(metres_per_pixel(glm::dvec3(target), viewport_height));
  target += of_pixel * (dy * up() - dx * right());
}

void Camera::zoom(float wheel_steps) {
  distance = std::clamp(distance * std::pow(0.875f, wheel_steps), 1e-3f, 1e6f);
}

namespace {

/// Of points on one axis of the picture (side, depth): where along `side` the eye stands, and how far ahead at most, so
/// that |side − eye| <= slope·(depth − ahead) holds of all. Each point bounds `ahead` by two lines over the eye's
/// place, one of either sign, so that only the least line of each sign counts.
struct Fit {
  float eye, ahead;
};

Fit fit(std::span<const glm::vec2> points, float slope) {
  float falling = 1e30f, rising = 1e30f;
  for (const glm::vec2& p : points) {
    falling = std::min(falling, p.y - p.x / slope);
    rising = std::min(rising, p.y + p.x / slope);
  }
  return {slope * (rising - falling) / 2, (falling + rising) / 2};
}

/// The eye's place that leaves as much room on one side as on the other, for an eye that far ahead: the narrowest slope
/// that still fits is found by halving.
float centered(std::span<const glm::vec2> points, float slope, float ahead) {
  float narrow = 0, wide = slope;
  for (int n = 0; n < 30; ++n) {
    const float middle = (narrow + wide) / 2;
    (fit(points, middle).ahead < ahead ? narrow : wide) = middle;
  }
  return fit(points, wide).eye;
}

}  // namespace

void Camera::frame(std::span<const glm::vec3> points, float aspect, glm::vec2 part, float covered, float below) {
  // The middle of what is free is a line from the eye that leans down: heights are taken from it.
  const float tan_y = std::tan(fov_y / 2), lean = (below - covered) * tan_y;
  std::vector<glm::vec2> across, upright;
  float nearest = 1e30f, farthest = -1e30f;
  for (const glm::vec3& p : points) {
    const float depth = glm::dot(p, forward());
    across.emplace_back(glm::dot(p, right()), depth);
    upright.emplace_back(glm::dot(p, up()) - lean * depth, depth);
    nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
  }
  const float middle = (nearest + farthest) / 2;
  const glm::vec2 slope = part * glm::vec2(tan_y * aspect, tan_y * (1 - covered - below));
  distance = std::clamp(middle - std::min(fit(across, slope.x).ahead, fit(upright, slope.y).ahead), 1e-3f, 1e6f);
  const float ahead = middle - distance;
  target = centered(across, slope.x, ahead) * right() + (centered(upright, slope.y, ahead) + lean * ahead) * up() +
           middle * forward();
}

void Camera::make_room(std::span<const glm::vec3> points, float aspect, float part, float covered, float below) {
  const float tan_y = std::tan(fov_y / 2), lean = (below - covered) * tan_y;
  const glm::vec2 slope = part * tan_y * glm::vec2(aspect, 1 - covered - below);
  float back = 0;
  for (const glm::vec3& p : points) {
    const glm::vec3 offset = p - target;
    const float depth = distance + glm::dot(offset, forward());  // before the eye
    // Moved back, what is in the middle of what is free stays there.
    const glm::vec2 apart = glm::abs(glm::vec2(glm::dot(offset, right()), glm::dot(offset, up()) - lean * depth));
    back = std::max(back, std::max(apart.x / slope.x, apart.y / slope.y) - depth);
  }
  back = std::min(back, 1e6f - distance);
  if (!(back > 0)) return;
  distance += back;
  target -= lean * back * up();
}

void Camera::frame(glm::vec3 lo, glm::vec3 hi, float aspect) {
  std::array<glm::vec3, 8> corners;
  for (int k = 0; k < 8; ++k) corners[k] = {k & 1 ? hi.x : lo.x, k & 2 ? hi.y : lo.y, k & 4 ? hi.z : lo.z};
  frame(corners, aspect, glm::vec2(0.88f));
}

std::optional<glm::vec2> Camera::project(glm::dvec3 world, glm::vec2 size) const {
  return Projector(*this, size)(world);
}

Projector::Projector(const Camera& camera, glm::vec2 size)
    : eye_(camera.eye()),
      ahead_(camera.forward()),
      right_(camera.right()),
      up_(camera.up()),
      middle_(size / 2.0f),
      pixels_per_slope_(size.y / (2 * std::tan(camera.fov_y / 2))),
      nearest_(0.01 * camera.distance) {}

std::optional<glm::vec2> Projector::operator()(glm::dvec3 world) const {
  const glm::dvec3 offset = world - eye_;
  const double depth = glm::dot(offset, ahead_);
  if (!(depth > nearest_)) return std::nullopt;
  return glm::vec2(middle_.x + pixels_per_slope_ * glm::dot(offset, right_) / depth,
                   middle_.y - pixels_per_slope_ * glm::dot(offset, up_) / depth);
}

glm::dvec3 Camera::ray(glm::vec2 pixel, glm::vec2 size) const {
  const double slope_per_pixel = 2 * std::tan(fov_y / 2) / size.y;
  return glm::normalize(glm::dvec3(forward()) + slope_per_pixel * ((pixel.x - size.x / 2.0) * glm::dvec3(right()) -
                                                                   (pixel.y - size.y / 2.0) * glm::dvec3(up())));
}

double Camera::metres_per_pixel(glm::dvec3 at, float viewport_height) const {
  const double depth = glm::dot(at - glm::dvec3(eye()), glm::dvec3(forward()));
  return 2 * depth * std::tan(fov_y / 2) / std::max(viewport_height, 1.0f);
}

glm::dvec3 Camera::unproject_in_camera_plane(glm::vec2 pixel, glm::dvec3 through, glm::vec2 size) const {
  const glm::dvec3 direction = ray(pixel, size), ahead(forward()), from(eye());
  const double depth = glm::dot(through - from, ahead);
  return from + direction * (depth / glm::dot(direction, ahead));
}

}  // namespace tyglab
