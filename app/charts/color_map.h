// Colours for magnitudes: evenly spaced to the eye, dark to light, and told apart by the colour-blind.
#pragma once

#include <imgui.h>

namespace tyglab {

/// From dark blue (0) over green to pale yellow (1), lightness rising evenly (interpolated in Oklab, B. Ottosson 2020).
ImU32 magnitude_color(double part);

}  // namespace tyglab
