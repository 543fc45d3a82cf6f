// The header of a lab's strip, and the buttons for its steps.
#pragma once

#include "app/session/lab_state.h"
#include "app/ui/kit/region.h"
#include "app/ui/state/ui.h"

namespace tyglab {

/// Back and on, which keep their places from step to step, what goes past a step, and what sets it up again.
void step_buttons(Ui& ui, LabRun& run, ImVec2 at);
/// The title, the buttons where `with_buttons`, and the cross. Returns whether the step's title had room.
bool lab_header(Ui& ui, LabRun& run, const Region& region, bool with_buttons);

}  // namespace tyglab
