// The legend of a colored cloth: quantity, symbol, unit, the colors and their values.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/render/field_colors.h"
#include "app/ui/kit/curve_plot.h"
#include "core/fields/particle_field.h"

namespace tyglab {

struct ColorLegend {
  const FieldInfo& field;
  ColorMap map;
  double top = 1;                     ///< of the scale, which begins at 0, or at -top where values have a sign
  bool root = false;                  ///< colors follow the square root of the values
  std::optional<double> marked = {};  ///< a value that is marked and said
  bool beyond = false;                ///< the ends stand for what is beyond them too
  bool grip = false;                  ///< the scale's end has a grip, and its number is left to the caller

  /// Place of a value along the colors, 0 to 1.
  double at(double value) const;
};

/// Where its parts were drawn, px.
struct LegendParts {
  ImVec2 number;          ///< middle of the right end of the number at the scale's end
  ImVec2 bar_lo, bar_hi;  ///< corners of the colors
};

/// The values that are written under the colors.
std::vector<PlotTick> legend_ticks(const ColorLegend& legend);
/// "Tension F_s, N": the heading without typesetting.
std::string legend_words(const FieldInfo& field);

/// Its size, px, where there is that much room for its width.
ImVec2 legend_size(const Theme& theme, float room);
/// The same of one on a single line, for a picture in which it would cover too much.
ImVec2 legend_line_size(const Theme& theme, float room);
/// The same with colors as short as can be read.
ImVec2 legend_short_line_size(const Theme& theme, float room);
/// Draws it of any of these sizes with its upper left corner there, on a ground of its own.
LegendParts draw_color_legend(const PlotPaint& paint, ImVec2 at, ImVec2 size, const ColorLegend& legend);

}  // namespace tyglab
