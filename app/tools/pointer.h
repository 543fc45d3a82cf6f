// The pointer in the viewport: orbit, pan, zoom, pick, pin, grab, cut, drag a body. A drag belongs to whoever took the
// press, until its button comes up.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/base/input.h"
#include "app/render/camera.h"
#include "core/model/preset.h"

namespace tyglab {

struct App;
class Simulation;

/// Where the viewport is in the window, and what lies over it.
struct Viewport {
  struct Box {
    glm::vec2 lo{0}, hi{0};
    bool contains(glm::vec2 p) const { return p.x >= lo.x && p.y >= lo.y && p.x < hi.x && p.y < hi.y; }
  };
  Box box;
  int columns = 1, rows = 1;  ///< pictures of one camera side by side: the cloth's, then its copies', row by row
  float buttons = 0;          ///< so much of each picture's height lies under the view's buttons, pixels
  std::vector<Box> covers;    ///< buttons and banners over it: presses there are theirs
  bool blocked = false;       ///< a menu or dialog is open: every press is its own
  glm::vec2 whole() const { return box.hi - box.lo; }
  /// Of one picture.
  glm::vec2 size() const { return whole() / glm::vec2(columns, rows); }
  /// Where the n-th picture begins, pixels in the window.
  glm::vec2 origin(int tile) const { return box.lo + size() * glm::vec2(tile % columns, tile / columns); }
  /// Where one more picture than those would begin; none where they take all places.
  std::optional<glm::vec2> free_place(int pictures) const {
    return pictures < columns * rows ? std::optional(origin(pictures)) : std::nullopt;
  }
  /// The picture under a pixel of the window; the nearest one where none is.
  int tile_at(glm::vec2 p) const;
  /// Divides the viewport for so many pictures.
  void divide(int pictures);
  bool takes(glm::vec2 p) const {
    if (blocked || !box.contains(p)) return false;
    for (const Box& cover : covers)
      if (cover.contains(p)) return false;
    return true;
  }
};

/// What the pointer is doing in the viewport.
struct Tool {
  enum class Kind { none, orbit, pan, right, grab, cut, body, wind };
  Kind kind = Kind::none;     ///< right: the right button is down and has not moved yet
  int button = 0;             ///< that ends it
  int tile = 0;               ///< the picture that was pressed
  glm::vec2 press{0}, at{0};  ///< pixels in that picture
  double press_time = 0;
  std::vector<glm::vec2> path;  ///< the pointer's way in this frame, for cuts
  /// A knife's way through a picture, as it is still seen.
  struct StrokePoint {
    glm::vec2 at{0};  ///< pixels in that picture
    double time = 0;  ///< s
    int tile = 0;
    bool begins = false;
  };
  std::vector<StrokePoint> stroke;
  /// Where the pointer rests over a picture, and the particle that was found there.
  struct Rest {
    glm::vec2 at{-1};
    int tile = 0;
    Camera camera;
    std::optional<Pins::Site> site;
  };
  Rest rest;
  unsigned wind_gesture = 0;  ///< each drag of the wind's arrow is undone by itself
  glm::dvec3 wind{0};         ///< N, as its arrow was pressed
  int body = -1;
  glm::dvec3 body_plane{0}, body_offset{0};
  std::optional<Pins::Site> site;  ///< under the right press
  glm::dvec3 hand{0};              ///< where the hand should go, m
  // For double clicks of the right button: the click before, as it was pressed and when it was let go.
  double last_click = -1;
  glm::vec2 last_press{0};
  std::optional<Pins::Site> last_site;
  bool second_press = false;  ///< this right press follows that click
};

/// Handles the frame's pointer events and what a held tool does every frame.
void handle_pointer(App& app);
/// The particle that a press would take, if the pointer is free over the viewport: of the cloth in the picture there.
std::optional<Pins::Site> particle_under_pointer(App& app);
/// The cloth whose picture stands there: the original's is 0.
Simulation& cloth_in_tile(App& app, int tile);
/// Whether a left press would take a body.
bool body_under_pointer(App& app);
/// Whether a left press would take the wind's arrow by its tip.
bool wind_under_pointer(const App& app);
/// How near to the pointer a particle is taken, pixels.
float pointer_reach(const App& app);
/// Whether the pointer grabs or cuts now.
bool hand_in_cloth(const App& app);
/// Sends the hand to the pointer over the next `steps` steps.
void move_hand(App& app, int steps);

}  // namespace tyglab
