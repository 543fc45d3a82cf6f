// The pictures of the cloth and its copies, redrawn only where something has changed.
#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "app/render/camera.h"
#include "app/render/cloth_renderer.h"

namespace tyglab {

struct Scene;

/// The longest edge that is drawn of a cloth, m; 0: all are. Particles that have flown off a diverged one would cover
/// it.
double longest_drawn_edge(const Simulation& cloth);

class ClothViews {
 public:
  /// Draws what the viewport shows; `magnified`: pixels of the picture to one of the window. Without an OpenGL context
  /// the cloth is framed and its colors are worked out, and nothing is drawn.
  void draw(Scene& scene, glm::vec2 magnified);
  /// Copies have been made again, perhaps where old ones stood, with the same count of changes.
  void forget_copies() { copies_.clear(); }
  /// The texture with the n-th picture of the viewport; 0 where there is no OpenGL context to draw it in.
  unsigned picture(const Scene& scene, int tile) const;
  /// The direction, in pixels of the screen, in which the cloth has left that picture; none while it is visible.
  std::optional<glm::vec2> way_to_cloth(const Scene& scene, int tile) const;

 private:
  /// The content of a picture.
  struct Drawn {
    const Simulation* cloth = nullptr;
    std::uint64_t revision = ~0ull;
    Camera camera;
    ViewOptions view;
    glm::ivec2 size{0};
    std::uint64_t values = 0;  ///< ClothColors::version
    bool operator==(const Drawn&) const = default;
  };
  /// Frames the cloths where that is asked for, and, until the camera is taken in hand, for each new size of a picture.
  void frame_cloths(Scene& scene, glm::vec2 shown);
  bool take_ghosts(Scene& scene, glm::ivec2 size);
  /// Returns what it took, ms; 0 where the last picture stays.
  double draw_picture(Scene& scene, int tile, glm::ivec2 size, bool ghosts_moved);
  ClothRenderer& renderer(Scene& scene, int tile);

  std::vector<std::unique_ptr<ClothRenderer>> copies_;  ///< of copies; the original's is App::renderer
  std::vector<Drawn> drawn_;                            ///< by picture
  std::vector<Ghost> ghosts_;
  std::vector<std::uint64_t> ghost_revisions_;
  glm::ivec2 size_{0};        ///< of a picture
  glm::vec4 framed_{0};       ///< width, height of a picture and what is covered of it, as it was framed last, pixels
  bool framed_away_ = false;  ///< a cloth was framed then that was not where the scene's camera looks
};

}  // namespace tyglab
