// Color scales for values: perceptually uniform, and distinguishable with color blindness. All are interpolated in
// Oklab (B. Ottosson 2020).
#pragma once

#include <imgui.h>

#include <vector>

namespace tyglab {

/// Which colors stand for values.
struct ColorMap {
  /// From blue over a pale middle to vermilion, both ends equally dark; otherwise from blue over green to pale yellow,
  /// lightness rising evenly.
  bool diverging = false;
  bool on_light = false;  ///< made to be seen before a light ground: the pale end is less pale, the dark one darker
  bool operator==(const ColorMap&) const = default;
};
ImU32 map_color(const ColorMap& map, double part);
/// That many of them, from the least to the greatest.
std::vector<ImU32> map_colors(const ColorMap& map, int count);

}  // namespace tyglab
