// Danger painted on the controls: where along a constant the method is stable, near its limit or unstable.
#pragma once

#include <string>
#include <string_view>

#include "app/studies/stability_watch.h"
#include "app/ui/kit/slider.h"
#include "app/ui/state/ui.h"

namespace tyglab {

/// A strip under the slider at `lo` to `hi`, for constants that have zones; nothing while dt is automatic, since it
/// then follows.
void draw_zones(Ui& ui, std::string_view key, const SliderScale& scale, ImVec2 lo, ImVec2 hi);

/// "Verlet is unstable above k_s = 412 N/m; implicit Euler is not." Empty for a constant without zones, and for methods
/// that no dt makes unstable.
std::string zone_words(const StabilityLimits& limits, std::string_view key, std::string_view unit);

}  // namespace tyglab
