// Scenes, presets and labs as cards with pictures: the start page and the dialog that opens presets.
#pragma once

#include "app/ui/state/ui.h"

namespace tyglab {

/// Looks for what there is now; labs only where asked for.
void fill_gallery(Ui& ui, bool labs);
/// The field that narrows it and the cards in a list of that height, pixels; closes the dialog and opens what is
/// chosen. What is wrong with a file becomes the dialog's problem.
void gallery(Ui& ui, float height);

}  // namespace tyglab
