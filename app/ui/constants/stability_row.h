// The gauge under dt: how much of what linear theory allows the present dt is.
#pragma once

#include <string>

#include "app/studies/stability_watch.h"

namespace tyglab {

struct Ui;

/// dt over dt_crit in any configuration, as a bar with a number; a mark where the limit of the cloth as it hangs lies.
void stability_row(Ui& ui);

/// The gauge's number: "0.57", "no limit", "always above".
std::string stability_text(const StabilityLimits& limits, double dt);
/// What its tooltip says.
std::string stability_words(const StabilityLimits& limits, double dt);

}  // namespace tyglab
