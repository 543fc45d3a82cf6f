// The parts drawn over the cloth; viewport_overlay() in panels.h draws them all.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "app/ui/kit/overlay_layout.h"
#include "app/ui/kit/theme.h"
#include "app/ui/state/ui.h"

namespace tyglab {

inline ImVec2 vec(glm::vec2 v) {
  return {v.x, v.y};
}
/// Pixel in the window of a place in a picture, if it is before the camera.
std::optional<ImVec2> on_screen(const Ui& ui, int tile, glm::dvec3 world);
std::optional<ImVec2> particle_on_screen(Ui& ui, int tile, Pins::Site site);

void ring(Ui& ui, ImDrawList& draw, ImVec2 at, float radius, ImU32 color, float width);
/// An arrow with a dark rim; one that is `cut_short` has an open head. False where it is too short to be drawn.
bool draw_arrow(Ui& ui, ImDrawList& draw, ImVec2 from, ImVec2 to, const CurveStyle& style, bool cut_short = false);
/// As much of the way from `from`, which lies in a picture, as stays in it. Whether something was cut off.
bool keep_in_picture(const Ui& ui, int tile, ImVec2 from, ImVec2& to);

/// The scales of the arrows at the picked particle, one each for forces, velocity and acceleration, in the corner of
/// the original's picture.
void arrow_scales(Ui& ui, ImDrawList& draw);
/// To those scales: the variables that are checked in the read-out, each with its symbol where there is room.
void particle_arrows(Ui& ui, ImDrawList& draw, int tile, ImVec2 from);
/// The wind's arrow with its strength.
void wind_overlay(Ui& ui, ImDrawList& draw);
/// The picked particle in every picture, with its arrows.
void picked_overlay(Ui& ui, ImDrawList& draw);
/// A ring round what diverges first: while its last steps are replayed, and once it has. Once the spring itself is too
/// long to be drawn, round the drawn cloth beside it.
void divergence_mark(Ui& ui, ImDrawList& draw);
/// The pointer with its tool, and the particle that it would take.
void pointer_overlay(Ui& ui, ImDrawList& draw);
/// Which scene it is, in presentation mode, where no bar says so. `row`: the picture's upper edge.
void scene_name(Ui& ui, ImDrawList& draw, const Box& row);
/// What the level lines beside a mass on a spring are: the spring's rest position and the equilibrium.
void level_labels(Ui& ui, ImDrawList& draw);
/// Of PAUSED without its keys, px.
glm::vec2 pause_mark_size(const Ui& ui);
/// How the panels that Tab has hidden come back, and which lab goes on meanwhile.
void hidden_panels_mark(Ui& ui, ImDrawList& draw);
/// How far the film is that is being exported; a click ends it.
void film_mark(Ui& ui, ImDrawList& draw);
/// What has been recorded, to go back and forth in, below the pictures.
void timeline_strip(Ui& ui, ImDrawList& draw, const Box& box);
/// Its height in a region of that height, px; 0 where there is none.
float timeline_height(const Ui& ui, float region);
/// PAUSED, where it covers no cloth if there is such a place. `row`: of the view buttons.
void pause_mark(Ui& ui, ImDrawList& draw, const Box& row);
/// At the foot of each picture, or overlaid one above the other: which cloth it is, and whether it has diverged; a
/// click on one that has tells why.
void cloth_names(Ui& ui, ImDrawList& draw);
/// Height that they take above overlaid cloths, px; 0 where they stand at the foot.
float names_above_height(const Ui& ui);
/// Height that they take at the foot of each picture of several, px; 0 where there is but one.
float names_below_height(const Ui& ui);
/// At the edge of each picture that its cloth has left: an arrow to where it is, which frames it.
void ways_to_cloth(Ui& ui, ImDrawList& draw);
/// Height of the strip below the pictures that a copy's details have in a region, px; 0 where there are none, or where
/// they would leave the pictures too little and stand over them.
float copy_details_strip(Ui& ui, glm::vec2 region);
/// Why a copy has diverged, where that was asked for (Ui::copy_details): at the foot of a region.
void copy_details(Ui& ui, const Box& region);
/// What is said of a divergence stands on it: a panel with a red rim that keeps presses from the cloth. `mark`: its
/// place belongs to that.
void danger_ground(Ui& ui, const Box& box, const char* mark);
/// Where cloth, weight and the wind's arrow are drawn: boxes of their parts.
std::vector<Box> drawn_parts(Ui& ui);
/// Where a knife has just gone along its path, fading.
void knife_stroke(Ui& ui, ImDrawList& draw);
/// After the first cut of all, how to pull instead and how to take it back.
void first_cut_hint(Ui& ui, ImDrawList& draw);
/// Outlines of triangles that cross each other, while they are counted.
void crossing_triangles(Ui& ui, ImDrawList& draw);
/// What a nick at the pointer would cut.
void springs_to_cut(Ui& ui, ImDrawList& draw);

// The cloth's picture, and the marks over it.

/// The five views (2.4), in the order of their keys.
inline constexpr std::array<const char*, 5> view_names{"1 Triangles", "2 Connections", "3 Both", "4 Outlines",
                                                       "5 Points"};

/// How far below the upper edge what stands under the view buttons begins, pixels at scale 1.
inline constexpr float under_views_at_1 = 44;

void viewport_panel(Ui& ui, const Region& region);
/// The list of what can color the cloth, at the cursor, and the legend of what does.
void color_menu(Ui& ui, float width);
/// As wide as it should be.
float color_menu_width(const Ui& ui);
void color_legend(Ui& ui);
void banner(Ui& ui, const Box& region);
/// Height at the foot of a region of that size that is the banner's own, so that it covers no cloth, px; 0 while there
/// is none.
float banner_strip(Ui& ui, glm::vec2 region);
/// The message that matters most, in front of the line at the foot of the window, and how many wait after it.
void message_line(Ui& ui, const Region& foot);

}  // namespace tyglab
