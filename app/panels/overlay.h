// What is drawn over the cloth, in parts; viewport_overlay() in panels.h draws it all.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/panels/theme.h"
#include "app/sandbox/app.h"

namespace tyglab {

inline ImVec2 vec(glm::vec2 v) {
  return {v.x, v.y};
}
/// Pixel in the window of a place in a picture, if it is before the camera.
std::optional<ImVec2> on_screen(const App& app, int tile, glm::dvec3 world);
std::optional<ImVec2> particle_on_screen(App& app, int tile, Pins::Site site);

void ring(App& app, ImDrawList& draw, ImVec2 at, float radius, ImU32 color, float width);
/// An arrow with a dark rim; one that is `cut_short` has an open head. False where it is too short to be drawn.
bool draw_arrow(App& app, ImDrawList& draw, ImVec2 from, ImVec2 to, const CurveStyle& style, bool cut_short = false);
/// As much of the way from `from`, which lies in a picture, as stays in it. Whether something was cut off.
bool keep_in_picture(const App& app, int tile, ImVec2 from, ImVec2& to);

/// The variables that are ticked in the read-out, at the picked particle: forces, velocity and acceleration each to one
/// scale, which stands in the corner.
void particle_arrows(App& app, ImDrawList& draw, int tile, ImVec2 from);
/// The wind's arrow with its strength.
void wind_overlay(App& app, ImDrawList& draw);
/// Where a knife has just gone along its path, fading.
void knife_stroke(App& app, ImDrawList& draw);
/// What a nick at the pointer would cut.
void springs_to_cut(App& app, ImDrawList& draw);

}  // namespace tyglab
