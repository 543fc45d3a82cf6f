// The map of stiffness against dt as a plot; a click sets both constants.
#pragma once

#include "app/ui/state/ui.h"

namespace tyglab {

/// Draws the map at the cursor; a click takes stiffness and dt from it, resting says what became of a cell.
void stability_map(Ui& ui, ImVec2 size);

}  // namespace tyglab
