#include "app/viewport/camera.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <numbers>

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
  const float metres_per_pixel = 2 * distance * std::tan(fov_y / 2) / std::max(viewport_height, 1.0f);
  target += metres_per_pixel * (dy * up() - dx * right());
}

void Camera::zoom(float wheel_steps) {
  distance = std::clamp(distance * std::pow(0.875f, wheel_steps), 1e-3f, 1e6f);
}

void Camera::frame(glm::vec3 lo, glm::vec3 hi, float aspect) {
  constexpr float margin = 0.88f;
  target = (lo + hi) / 2.0f;
  const float tan_y = margin * std::tan(fov_y / 2), tan_x = tan_y * aspect;
  float needed = 1e-3f;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::vec3 p(corner & 1 ? hi.x : lo.x, corner & 2 ? hi.y : lo.y, corner & 4 ? hi.z : lo.z);
    const glm::vec3 offset = p - target;
    const float side = std::max(std::abs(glm::dot(offset, right())) / tan_x, std::abs(glm::dot(offset, up())) / tan_y);
    needed = std::max(needed, side - glm::dot(offset, forward()));
  }
  distance = std::min(needed, 1e6f);
}

std::optional<glm::vec2> Camera::project(glm::dvec3 world, glm::vec2 size) const {
  const glm::dvec3 offset = world - glm::dvec3(eye());
  const double depth = glm::dot(offset, glm::dvec3(forward()));
  if (!(depth > 0.01 * distance)) return std::nullopt;
  const double pixels_per_slope = size.y / (2 * std::tan(fov_y / 2));
  return glm::vec2(size.x / 2 + pixels_per_slope * glm::dot(offset, glm::dvec3(right())) / depth,
                   size.y / 2 - pixels_per_slope * glm::dot(offset, glm::dvec3(up())) / depth);
}

glm::dvec3 Camera::ray(glm::vec2 pixel, glm::vec2 size) const {
  const double slope_per_pixel = 2 * std::tan(fov_y / 2) / size.y;
  return glm::normalize(glm::dvec3(forward()) + slope_per_pixel * ((pixel.x - size.x / 2.0) * glm::dvec3(right()) -
                                                                   (pixel.y - size.y / 2.0) * glm::dvec3(up())));
}

glm::dvec3 Camera::unproject_in_camera_plane(glm::vec2 pixel, glm::dvec3 through, glm::vec2 size) const {
  const glm::dvec3 direction = ray(pixel, size), ahead(forward()), from(eye());
  const double depth = glm::dot(through - from, ahead);
  return from + direction * (depth / glm::dot(direction, ahead));
}

}  // namespace tyglab
