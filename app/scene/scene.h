// The visible side of the session: camera, views, colors, effects, and the pictures of the cloth and its copies.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>

#include "app/base/input.h"
#include "app/render/camera.h"
#include "app/render/cloth_renderer.h"
#include "app/scene/cloth_colors.h"
#include "app/scene/cloth_views.h"
#include "app/scene/effects.h"
#include "app/session/session.h"

namespace tyglab {

struct Scene {
  explicit Scene(Session& of) : session(of) {}

  Session& session;
  std::unique_ptr<ClothRenderer> renderer;  ///< null until there is an OpenGL context
  ClothViews views;
  Camera camera;
  ViewOptions view;
  ClothColors colors;
  Effects effects;
  Viewport viewport;
  float scale = 1;                                       ///< of lines and points, as of the text
  std::array<glm::vec3, Lockstep::most> ghost_colors{};  ///< of overlaid copies
  bool redraw = true;           ///< something that the renderer's revision does not tell changed (a texture)
  bool wants_framing = true;    ///< the camera is to frame the scene once the viewport's size is known
  bool camera_by_hand = false;  ///< it was turned, moved or zoomed since: a picture of another size frames nothing

  /// Follows the changes of the session since the last call.
  void follow();
  /// Draws what has changed; `magnified`: pixels of the picture to one of the window.
  void draw(glm::vec2 magnified);

 private:
  void follow_restart();
  SessionCounts seen_;
  double seen_time_ = 0;     ///< of the cloth, s
  glm::dvec2 extent_{0};     ///< of the cloth that was seen last, m
  bool lab_colors_ = false;  ///< a step of a lab has colored the cloth
  /// How the user's experiment was seen when a lab took its place.
  struct OwnLook {
    Camera camera;
    bool by_hand;
    std::optional<ParticleField> color;
  };
  std::optional<OwnLook> own_look_;
};

/// The cloth whose picture stands there: the original's is 0.
Simulation& cloth_in_tile(const Scene& scene, int tile);

}  // namespace tyglab
