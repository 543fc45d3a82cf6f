// Color scales for values: perceptually uniform, and distinguishable with color blindness. All are interpolated in
// Oklab (B. Ottosson 2020).
#pragma once

#include <imgui.h>

#include <vector>

namespace tyglab {

/// From dark blue (0) over green to pale yellow (1), lightness rising evenly.
ImU32 magnitude_color(double part);

/// Which colors a cloth has by its values.
struct ColorMap {
  bool diverging = false;  ///< from blue over a pale middle to vermilion, both ends equally dark; else as a magnitude
  bool on_light = false;   ///< made to be seen before a light ground: the pale end is less pale, the dark one darker
  bool operator==(const ColorMap&) const = default;
};
ImU32 map_color(const ColorMap& map, double part);
/// That many of them, from the least to the greatest.
std::vector<ImU32> map_colors(const ColorMap& map, int count);

}  // namespace tyglab
