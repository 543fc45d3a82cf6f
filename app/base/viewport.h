// The part of the window that shows the cloth.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace tyglab {

/// Where the viewport is in the window, and what lies over it.
struct Viewport {
  struct Box {
    glm::vec2 lo{0}, hi{0};
    bool contains(glm::vec2 p) const { return p.x >= lo.x && p.y >= lo.y && p.x < hi.x && p.y < hi.y; }
  };
  Box box;
  int columns = 1, rows = 1;  ///< pictures of one camera side by side: the cloth's, then its copies', row by row
  float buttons = 0;          ///< that much of each picture's height is left to buttons and marks, pixels
  float foot = 0;             ///< and that much at its lower edge to the name of its cloth
  float filled = 0.84f;       ///< the part of what is left that framing gives to the cloth
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
  /// Divides the viewport for that many pictures.
  void divide(int pictures);
  bool takes(glm::vec2 p) const {
    if (blocked || !box.contains(p)) return false;
    for (const Box& cover : covers)
      if (cover.contains(p)) return false;
    return true;
  }
};

}  // namespace tyglab
