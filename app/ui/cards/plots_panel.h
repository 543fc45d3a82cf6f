// The column of plots and cards.
#pragma once

#include "app/ui/kit/region.h"
#include "app/ui/state/ui.h"

namespace tyglab {

void plots_panel(Ui& ui, const Region& region);
/// What the cards that it shows in a region of that size (px) want to be worked out, drawn or not; where it has none,
/// but will have its turn, what is recorded for then.
Wants plots_want(const Ui& ui, ImVec2 size, bool take_turns);

}  // namespace tyglab
