// A sketch of a scene, drawn in the theme's colors.
#pragma once

#include <imgui.h>

#include "app/base/image.h"
#include "app/ui/kit/fonts.h"
#include "app/ui/kit/theme.h"

namespace tyglab {

struct SceneSketch;

/// Into the box from lo to hi, pixels, and nowhere else.
void draw_scene(ImDrawList& draw, const Theme& theme, const SceneSketch& sketch, ImVec2 lo, ImVec2 hi);

// Dear ImGui without a window, for pictures that are written to files.

/// Lives in the OpenGL context that is current; one at a time, and a window's own Dear ImGui comes back after it. What
/// is drawn goes into draw(), and pixels() ends it.
class PictureGui {
 public:
  PictureGui(ImVec2 size, const Theme& theme);
  ~PictureGui();
  PictureGui(const PictureGui&) = delete;
  PictureGui& operator=(const PictureGui&) = delete;
  const Fonts& fonts() const { return fonts_; }
  ImDrawList& draw() const;
  /// Draws a texture over all of it, whose first row is the picture's bottom one.
  void show(unsigned texture) const;
  /// The picture. Throws GraphicsError.
  Image pixels() const;

 private:
  ImGuiContext* window_;  ///< null without a window
  ImVec2 size_;
  Fonts fonts_;
};

}  // namespace tyglab
