// The map of stiffness against dt as a chart, in the window and as a picture.
#pragma once

#include <span>

#include "app/ui/kit/chart.h"
#include "core/analysis/stability_map.h"

namespace tyglab {

/// Cells colored by the energy added or removed, or hatched where it diverged; theory's borders between
/// its zones as lines; the preset's own place as a disc.
Chart map_chart(const Tokens& colors, const Preset& preset, const MapGrid& grid, const MapBoundary& boundary,
                std::span<const MapCell> cells);

/// The same with a title and a quiet note under it, as it is written to a file.
Chart map_page(const Tokens& colors, const Preset& preset, const std::string& label, const std::string& note,
               const MapGrid& grid, const MapBoundary& boundary, std::span<const MapCell> cells);

/// What a short run came to, as a sentence without its end: "k_s = 92 N/m, dt = 0.0013 s: diverged after 0.12 s".
std::string cell_words(const Preset& preset, const MapCell& cell);

}  // namespace tyglab
