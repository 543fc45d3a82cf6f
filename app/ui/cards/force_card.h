// The forces of the picked particle, their sums or their maxima, over time.
#pragma once

namespace tyglab {

struct Ui;

/// The card, and the height below which its curves could not be read (px, of a card of that width).
void force_card(Ui& ui, float height);
float force_card_least(const Ui& ui, float width);

}  // namespace tyglab
