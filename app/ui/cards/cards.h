// The names of the cards in the plots column, as on their tabs and headings.
#pragma once

#include <string_view>

#include "app/base/settings.h"

namespace tyglab {

struct Ui;

namespace card_name {
inline constexpr const char *height = "Height", *forces = "Forces", *distances = "Distances", *map = "Map",
                            *step = "Step", *copies = "Copies", *stability = "Stability", *accuracy = "Accuracy",
                            *energy = "Energy", *performance = "Performance";
}

/// Whether it is the card whose tab is chosen.
bool in_front(const Ui& ui, std::string_view name);
/// Brings a card into sight: the column, its tab where it is one, what stands under its heading.
void show_card(Ui& ui, std::string_view name);
/// What a lab's step shows, by its name in lab_cards; empty: nothing. In a narrow window the lab itself stays in sight:
/// the card is the one that its column shows.
void show_for_lab(Ui& ui, std::string_view name);
/// Closes what labs have opened so.
void close_lab_cards(Ui& ui);
}  // namespace tyglab
