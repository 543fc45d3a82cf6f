// The pointer in the viewport: orbit, pan, zoom, pick, pin, grab, cut, drag a body. A drag belongs to the tool that
// received the press, until the button is released.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/base/input.h"
#include "app/render/camera.h"
#include "core/model/preset.h"

namespace tyglab {

struct Tools;
class Simulation;

/// The action of the pointer in the viewport.
struct Tool {
  enum class Kind { none, orbit, pan, right, grab, cut, body, wind };
  Kind kind = Kind::none;     ///< right: the right button is down and has not moved yet
  int button = 0;             ///< that ends it
  int tile = 0;               ///< the picture that was pressed
  glm::vec2 press{0}, at{0};  ///< pixels in that picture
  double press_time = 0;
  std::vector<glm::vec2> path;  ///< the pointer's path in this frame, for cuts
  /// The visible stroke of a knife through a picture.
  struct StrokePoint {
    glm::vec2 at{0};  ///< pixels in that picture
    double time = 0;  ///< s
    int tile = 0;
    bool begins = false;
  };
  std::vector<StrokePoint> stroke;
  /// The resting place of the pointer over a picture, and the particle there.
  struct Rest {
    glm::vec2 at{-1};
    int tile = 0;
    Camera camera;
    std::optional<Pins::Site> site;
  };
  Rest rest;
  unsigned knife_gesture = 0;              ///< each stroke likewise
  unsigned wind_gesture = 0;               ///< each drag of the wind's arrow is undone by itself
  glm::dvec3 Preset::*wind_key = nullptr;  ///< what its arrow stood for when it was pressed
  glm::dvec3 wind{0};                      ///< N or m/s, as its arrow was pressed
  glm::vec2 wind_foot{0};                  ///< where that arrow begins, pixels in the first picture
  int body = -1;
  glm::dvec3 body_plane{0}, body_offset{0};
  std::optional<glm::dvec3> body_to;  ///< where the steps of this frame take the body, with the drag's velocity
  std::optional<Pins::Site> site;     ///< under the right press
  glm::dvec3 hand{0};                 ///< where the hand should go, m
  // For double clicks of the right button: the click before, as it was pressed and when it was let go.
  double last_click = -1;
  glm::vec2 last_press{0};
  std::optional<Pins::Site> last_site;
  bool second_press = false;  ///< this right press follows that click
};

/// Handles the frame's pointer events and what a held tool does every frame.
void handle_pointer(Tools& tools);
/// The particle that a press would take, if the pointer is free over the viewport: of the cloth in the picture there.
std::optional<Pins::Site> particle_under_pointer(Tools& tools);
/// Whether a left press would take a body.
bool body_under_pointer(Tools& tools);
/// Whether a left press would take the wind's arrow by its tip.
bool wind_under_pointer(const Tools& tools);
/// The mouse's button, GLFW_MOUSE_BUTTON_…, that a finger put there stands for.
int finger_button(Tools& tools, glm::vec2 at);
/// Reach of the pointer for particles, pixels.
float pointer_reach(const Tools& tools);
/// Whether the pointer grabs or cuts now.
bool hand_in_cloth(const Tools& tools);

}  // namespace tyglab
