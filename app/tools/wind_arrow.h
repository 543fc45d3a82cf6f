// The wind as an arrow with a draggable tip.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace tyglab {

struct Tools;

/// An arrow in space, near the lower right corner of the first picture.
struct WindArrow {
  glm::dvec3 base{0}, tip{0};    ///< m
  double metres_per_newton = 0;  ///< so long is what is drawn of W, unless it would leave its place
};

/// Whether the arrow is shown: while there is wind, or as it was asked for.
bool wind_arrow_shown(const Tools& tools);
/// The arrow of a wind W, N: as long as 80 pixels for the wind of the preset as it was opened, or, where that has
/// none, for the weight of a particle; shorter where it would leave the picture.
WindArrow wind_arrow(const Tools& tools, const glm::dvec3& W);
/// Whether a press at that pixel of the first picture takes the tip.
bool on_wind_tip(const Tools& tools, glm::vec2 at);
/// The tip has been pressed, and is dragged: W follows in the plane of the camera; with Shift along the view; with Ctrl
/// along the nearest axis. Every drag is one change to undo.
void take_wind(Tools& tools);
void drag_wind(Tools& tools);

}  // namespace tyglab
