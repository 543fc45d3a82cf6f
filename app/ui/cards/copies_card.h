// The card of the copies in lockstep: the list of copies, their costs, and their distances.
#pragma once

#include "app/ui/state/ui.h"

namespace tyglab {

/// How far apart the cloths are, or their energies, over time, at the cursor.
void copies_plot(Ui& ui, ImVec2 size);

/// The card in the plots column, closed unless the user has opened it or added a copy, and its height (pixels).
void copies_card(Ui& ui, float height);
float copies_card_height(const Ui& ui, float width);

}  // namespace tyglab
