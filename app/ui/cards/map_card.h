// The map of stiffness against dt as a plot: a click goes there.
#pragma once

#include "app/ui/app.h"

namespace tyglab {

/// Draws the map at the cursor; a click takes stiffness and dt from it, resting says what became of a cell.
void stability_map(App& app, ImVec2 size);

}  // namespace tyglab
