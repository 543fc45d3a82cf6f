// Stability zones on the controls: where along a constant the method is stable in any shape of the cloth, where this
// depends on the shape, and where the method is unstable in every shape.
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

/// Color and paint of a zone, the same wherever it is drawn. Color is never the only sign: stable is a thin line, what
/// depends on the shape is dashed, what is unstable is hatched and thicker.
ImU32 zone_color(const Tokens& colors, Zone zone);
void draw_zone(Ui& ui, Zone zone, ImVec2 lo, ImVec2 hi);

/// The present zone, and where along the constant the zones lie: "Depends on the shape: dt is 115 % of …. Verlet at
/// this dt: k_s up to 133 N/m stable in any shape, …". Empty for a constant without zones, and for methods that no dt
/// makes unstable.
std::string zone_words(const StabilityLimits& limits, std::string_view key, std::string_view unit);

}  // namespace tyglab
