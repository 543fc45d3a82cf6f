// The forces of the picked particle, their sums or their largest, over time.
#pragma once

#include "app/ui/app.h"

namespace tyglab {

/// The card, and the height below which its curves could not be read (px, of a card of that width).
void force_card(App& app, float height);
float force_card_least(const App& app, float width);

}  // namespace tyglab
