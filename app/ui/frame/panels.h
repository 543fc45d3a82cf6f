// The regions of the window, one file each.
#pragma once

#include <imgui.h>

#include <array>

#include "app/ui/ui.h"
#include "core/model/notation.h"

namespace tyglab {

/// The five views (2.4), in the order of their keys.
inline constexpr std::array<const char*, 5> view_names{"1 Triangles", "2 Connections", "3 Both", "4 Outlines",
                                                       "5 Points"};

/// A region's place, pixels.
struct Region {
  ImVec2 at, size;
};

void top_bar(Ui& ui, const Region& region);
void constants_panel(Ui& ui, const Region& region);
/// Contents of the constants panel, section by section.
void constants_sections(Ui& ui);
/// Brings a constant's row into sight, with its slider in focus.
void show_constant(Ui& ui, std::string_view key);
/// Whether the constant plays a part in this scene.
bool applies(const PresetRow& row, const Preset& preset);
void body_sections(Ui& ui);
void view_section(Ui& ui);
/// The picked particle's variables of table B.1; part of the constants panel.
void particle_panel(Ui& ui);
float particle_panel_height(const Ui& ui);
void plots_panel(Ui& ui, const Region& region);
void viewport_panel(Ui& ui, const Region& region);
/// The list of what can colour the cloth, at the cursor, and the legend of what does.
void color_menu(Ui& ui, float width);
/// As wide as it should be.
float color_menu_width(const Ui& ui);
void color_legend(Ui& ui);
void banner(Ui& ui);
void message_list(Ui& ui);
void status_bar(Ui& ui, const Region& region);
void help_overlay(Ui& ui);
/// The lab in work, below the viewport; its height is 0 where there is none.
void lab_panel(Ui& ui, const Region& region);
float lab_panel_height(const Ui& ui, float available);
/// From this width on (pixels at scale 1) it has two columns.
inline constexpr float lab_two_columns = 544;

/// Starts a region as a fixed window with the given ground.
bool begin_region(const char* name, const Region& region, ImU32 ground, ImVec2 padding);
void end_region();

/// All regions, with the borders between them that drag.
void draw_layout(Ui& ui, ImVec2 window);

}  // namespace tyglab
