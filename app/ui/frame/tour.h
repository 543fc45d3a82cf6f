// A few cards that introduce the sandbox: once at the first start, and again from the help.
#pragma once

#include "app/ui/state/ui.h"

namespace tyglab {

void start_tour(Ui& ui);
/// Draws the present card, beside what it tells of.
void tour_card(Ui& ui);

}  // namespace tyglab
