// Finds what is under the pointer.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "app/render/camera.h"
#include "core/cloth/state.h"
#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

struct Hit {
  int i, j;
};

/// The particle whose picture is nearest to the pixel, within `reach_px`. Of those that are equally near (to half a
/// pixel) the one nearest to the eye. `skip(i, j)` leaves particles out (pinned ones for a grab); may be empty.
std::optional<Hit> nearest_particle(const PositionView& positions, const Camera& camera, glm::vec2 pixel,
                                    glm::vec2 size, float reach_px, const std::function<bool(int, int)>& skip = {});

/// The particles that a cut takes on the pointer's path from `from` to `to` (2.3.4): at each point of the way, two
/// pixels or less apart, the nearest particle within reach. Each stands once, in the order of the way.
std::vector<Pins::Site> particles_near_path(const PositionView& positions, const Camera& camera, glm::vec2 from,
                                            glm::vec2 to, glm::vec2 size, float reach_px);

/// Distance from the eye along the ray (of length 1) to the near side of a sphere, m; none if the ray misses it or it
/// lies behind.
std::optional<double> sphere_surface(glm::dvec3 eye, glm::dvec3 ray, glm::dvec3 center, double r);

/// The same for any body that rests; none for planes, and where the eye is inside.
std::optional<double> body_surface(glm::dvec3 eye, glm::dvec3 ray, const Body& body);

/// Index of the body under the pixel that is nearest to the eye. Planes cannot be dragged and are never met.
std::optional<int> body_under(const std::vector<Body>& bodies, const Camera& camera, glm::vec2 pixel, glm::vec2 size);

// Finds the springs that a stroke across the picture crosses.

/// A way across the picture, pixels.
struct Stroke {
  glm::vec2 from, to;
};

/// The whole stretch springs, edges of triangles among them, whose pictures one of the ways crosses: through all layers
/// of the cloth, as scissors go, but not through what a body hides. A spring that meets the end of one way and the
/// beginning of the next is crossed by one of them. Each stands once, in the order of their owners.
std::vector<SpringSite> springs_across(const PositionView& positions, const Tears& tears, const Camera& camera,
                                       std::span<const Body> bodies, std::span<const Stroke> strokes, glm::vec2 size);

}  // namespace tyglab
