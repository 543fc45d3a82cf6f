// The next step of the picked particle: formulas, formulas with numbers, results.
#pragma once

#include <string>

#include "app/ui/state/ui.h"

namespace tyglab {

/// Writes it at the cursor, in that much room; it scrolls.
void inside_step(Ui& ui, ImVec2 size);

/// "d + dt² a", as the method's table says it.
std::string formula_of(const Scheme& method, const TracedAssignment& assignment);

}  // namespace tyglab
