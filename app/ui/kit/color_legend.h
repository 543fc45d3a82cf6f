// What a colored cloth's colors mean: quantity, symbol, unit, the colors and the values that they stand for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/render/color_map.h"
#include "app/ui/kit/curve_plot.h"
#include "core/fields/particle_field.h"

namespace tyglab {

struct ColorLegend {
  const FieldInfo& field;
  ColorMap map;
  double top = 1;                     ///< of the scale, which begins at 0, or at -top where values have a sign
  std::optional<double> marked = {};  ///< a value that is marked and said
  bool beyond = false;                ///< the ends stand for what is beyond them too
  bool top_is_drawn = true;           ///< otherwise the number at the scale's end is left to who calls
};

/// The values that are written under the colors.
std::vector<PlotTick> legend_ticks(const FieldInfo& field, double top);
/// "Tension F_s, N": the heading without typesetting.
std::string legend_words(const FieldInfo& field);

/// Its size, px, where there is that much room for its width.
ImVec2 legend_size(const Theme& theme, float room);
/// The same of one on a single line, for a picture in which it would cover too much.
ImVec2 legend_line_size(const Theme& theme, float room);
/// The same with colors as short as can be read.
ImVec2 legend_short_line_size(const Theme& theme, float room);
/// Draws it of any of these sizes with its upper left corner there, on a ground of its own. Returns where the number at
/// the scale's end belongs: the middle of its right end.
ImVec2 draw_color_legend(const PlotPaint& paint, ImVec2 at, ImVec2 size, const ColorLegend& legend);

}  // namespace tyglab
