// The column of plots and cards.
#pragma once

#include "app/ui/kit/region.h"
#include "app/ui/state/ui.h"

namespace tyglab {

void plots_panel(Ui& ui, const Region& region);
/// What the cards that it shows in a region of that size (px) want to be worked out, drawn or not.
Wants plots_want(const Ui& ui, ImVec2 size);

}  // namespace tyglab
