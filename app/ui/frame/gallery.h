// Scenes, presets and labs as cards with pictures: the start page and the dialog that opens presets.
#pragma once

#include <functional>

#include "app/ui/state/ui.h"

namespace tyglab {

/// Looks for what there is now; labs only where asked for.
void fill_gallery(Ui& ui, bool labs);
/// What stands over it (in a `low` window it scrolls with the cards, and is brief), the field that narrows it, and the
/// cards in a list; closes the dialog and opens what is chosen. What is wrong with a file becomes the dialog's problem.
void gallery(Ui& ui, const std::function<void(bool low)>& head);
/// Whether a card is chosen by keys or by what was typed, and opening it as a click on it does.
bool gallery_choice(const Ui& ui);
void open_gallery_choice(Ui& ui);
/// Called when the rest of the dialog stands: the list's height leaves room for that.
void end_gallery(Ui& ui);

}  // namespace tyglab
