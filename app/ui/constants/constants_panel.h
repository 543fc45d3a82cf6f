// The left column: every constant of the notation table that the scene uses, and the picked particle.
#pragma once

#include <string_view>

#include "app/ui/kit/region.h"
#include "app/ui/state/ui.h"
#include "core/model/notation.h"

namespace tyglab {

void constants_panel(Ui& ui, const Region& region);
/// The method, to be chosen.
void integrator_row(Ui& ui);
/// Its contents, section by section.
void constants_sections(Ui& ui);
void body_sections(Ui& ui);
void view_section(Ui& ui);
/// The picked particle's variables of table B.1.
void particle_panel(Ui& ui);
float particle_panel_height(const Ui& ui);
/// Brings a constant's row into sight, with its slider in focus.
void show_constant(Ui& ui, std::string_view key);
/// The column scrolls to that constant's row where it would not be seen, and unfolds its section.
void bring_into_sight(Ui& ui, std::string_view key);
/// Whether the constant plays a part in this scene.
bool applies(const PresetRow& row, const Preset& preset);

}  // namespace tyglab
