// The height of the mass on a spring over time, beside the curves of figure 3.2.
#pragma once

namespace tyglab {

struct Ui;

/// The card, and the height below which its curves could not be read (px, of a card of that width).
void height_card(Ui& ui, float height);
float height_card_least(const Ui& ui, float width);

}  // namespace tyglab
