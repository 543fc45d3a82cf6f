// The column of plots and cards.
#pragma once

#include "app/ui/kit/region.h"
#include "app/ui/state/ui.h"

namespace tyglab {

void plots_panel(Ui& ui, const Region& region);

}  // namespace tyglab
