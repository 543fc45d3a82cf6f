// The bars, everything that lies above the window, and the division of the window between all regions.
#pragma once

#include "app/ui/kit/region.h"
#include "app/ui/state/ui.h"

namespace tyglab {

void top_bar(Ui& ui, const Region& region);
void status_bar(Ui& ui, const Region& region);
void help_overlay(Ui& ui);
/// Everything that can be done, while the popup of that name is open.
void application_menu(Ui& ui, const char* id);
/// The current lab, below the viewport; its height is 0 where there is none.
void lab_panel(Ui& ui, const Region& region);
float lab_panel_height(const Ui& ui, float available);
/// From this width on (pixels at scale 1) it has two columns.
inline constexpr float lab_two_columns = 544;

/// What presentation mode has in place of bars and columns, below the cloth.
void podium(Ui& ui, const Region& region);
float podium_height(const Ui& ui);
/// Whether it has the simulated time, in a window of that width, px; otherwise that is in the picture.
bool time_on_podium(const Ui& ui, float width);
/// Of the card beside the cloth, in a window of that width, px; 0 where it has no room.
float presented_card_width(const Ui& ui, float window);

/// All regions, with the borders between them that drag.
void draw_layout(Ui& ui, ImVec2 window);
/// What they want to be worked out, in a window of that size (px): by what is open and has room, drawn or not.
Wants layout_wants(const Ui& ui, ImVec2 window);

}  // namespace tyglab
