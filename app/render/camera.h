// A camera that orbits a point. Angles in radians, lengths in meters, pixels with y down from the top left corner.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

struct Camera {
  glm::vec3 target{0, 0, 0};
  float distance = 2;
  float yaw = 0.35f;    ///< 0 looks along -z; grows as the eye goes round to +x
  float pitch = 0.18f;  ///< height of the eye over the horizon of the target; within ±85 degrees
  float fov_y = 0.62f;  ///< vertical field of view

  glm::vec3 eye() const;
  glm::vec3 right() const;
  glm::vec3 up() const;
  glm::vec3 forward() const;
  glm::mat4 view() const;
  glm::mat4 projection(float aspect) const;

  /// Turns the scene under a drag of (dx, dy) pixels: half a turn takes 600 pixels.
  void orbit(float dx, float dy);
  /// Moves the target with the pointer: the point under it stays under it.
  void pan(float dx, float dy, float viewport_height);
  /// Positive steps come nearer, an eighth of the distance a step.
  void zoom(float wheel_steps);
  /// Comes as near as it can while the points keep within that part of the picture's width and height; keeps the
  /// direction. The points then stand in the middle of the picture. Something covers that much of its height along the
  /// upper edge (`covered`, 0 to 0.5) and along the lower one (`below`): only what is left counts as the picture.
  void frame(std::span<const glm::vec3> points, float aspect, glm::vec2 part, float covered = 0, float below = 0);
  /// Goes back along its direction, no further than it must, until the points keep within that part of the picture.
  void make_room(std::span<const glm::vec3> points, float aspect, float part, float covered = 0, float below = 0);
  /// Puts the box (corners lo, hi) into view; keeps the direction.
  void frame(glm::vec3 lo, glm::vec3 hi, float aspect);

  /// Pixel of a point, none when it is behind the camera. `size` is the viewport's, in pixels.
  std::optional<glm::vec2> project(glm::dvec3 world, glm::vec2 size) const;
  /// Meters that a pixel shows at the depth of a place.
  double metres_per_pixel(glm::dvec3 at, float viewport_height) const;
  /// The point under the pixel in the plane through `through` that is parallel to the camera plane ("The hand").
  glm::dvec3 unproject_in_camera_plane(glm::vec2 pixel, glm::dvec3 through, glm::vec2 size) const;
  /// Unit direction from the eye through a pixel.
  glm::dvec3 ray(glm::vec2 pixel, glm::vec2 size) const;

  bool operator==(const Camera&) const = default;
};

/// Camera::project for many points: the terms that depend only on the camera are computed once.
class Projector {
 public:
  Projector(const Camera& camera, glm::vec2 size);
  std::optional<glm::vec2> operator()(glm::dvec3 world) const;
  /// Distance before the camera, m.
  double depth(glm::dvec3 world) const { return glm::dot(world - eye_, ahead_); }

 private:
  glm::dvec3 eye_, ahead_, right_, up_;
  glm::dvec2 middle_;
  double pixels_per_slope_, nearest_;
};

/// An axis-aligned box, m. Empty while lo > hi.
struct Bounds {
  glm::vec3 lo{1e30f}, hi{-1e30f};
  bool empty() const { return lo.x > hi.x; }
  void add(glm::vec3 point);
  void add(const Bounds& other);
};

/// The box of all finite particles.
Bounds bounds(const PositionView& positions);
/// A box round a body that rests; of what is much larger than the cloth, round the part at the cloth. None for planes.
std::optional<Bounds> body_bounds(const Body& body, const Bounds& cloth);
/// The box of a preset's start and of its place at rest, with its spheres: the first view of the scene.
Bounds scene_bounds(const Preset& preset);
/// A camera in the default direction that frames scene_bounds, between what covers those parts of the picture's height
/// along its upper and lower edge, so that the cloth takes that part of what is left.
Camera scene_camera(const Preset& preset, float aspect, float covered = 0, float below = 0, float filled = 0.84f);
/// The same camera as long as it shows the cloth well, whose particles are now within that box; otherwise it frames the
/// box, with the spheres beside it. Of an empty box nothing is known.
Camera present_camera(const Preset& preset, Bounds cloth, float aspect, float covered = 0, float below = 0,
                      float filled = 0.84f);

/// A part of a picture, 0 to 1 each way from the upper left corner; more than that lies outside.
struct PicturePart {
  glm::vec2 lo{0}, hi{0};
  /// How much of it is in the picture, 0 to 1; all of it where it fills the picture.
  float in_sight() const;
};
/// The part that holds a box; the whole picture where the box reaches behind the camera, none where all of it is there.
std::optional<PicturePart> part_of_picture(const Camera& camera, const Bounds& box, float aspect);

/// Height of the plane on which a cloth lands: the highest one below its start; none if there is no plane below.
std::optional<double> floor_height(const Preset& preset);
/// Height of the drawn ground: that plane's, or else a little below all that scene_bounds holds.
double ground_height(const Preset& preset);

}  // namespace tyglab
