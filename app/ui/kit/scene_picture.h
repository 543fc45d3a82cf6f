// A sketch of a scene, drawn in the theme's colors.
#pragma once

#include <imgui.h>

#include "app/ui/kit/theme.h"

namespace tyglab {

struct SceneSketch;

/// Into the box from lo to hi, pixels, and nowhere else.
void draw_scene(ImDrawList& draw, const Theme& theme, const SceneSketch& sketch, ImVec2 lo, ImVec2 hi);

}  // namespace tyglab
