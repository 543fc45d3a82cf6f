// A handful of cards that show a newcomer round: once at the first start, and again from the help.
#pragma once

#include "app/ui/app.h"

namespace tyglab {

void start_tour(App& app);
/// Draws the present card, beside what it tells of.
void tour_card(App& app);

}  // namespace tyglab
