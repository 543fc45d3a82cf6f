#include "app/ui/kit/chart.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/text.h"
#include "app/render/field_colors.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"
#include "core/theory/zones.h"

namespace tyglab {
namespace {

constexpr double least_share = 1e-6, most_share = 1;  // of the colors

double part_of(double share) {
  const double size = std::max(std::abs(share), least_share);
  return std::log(size / least_share) / std::log(most_share / least_share);
}

ImU32 color_of_share(const Tokens& c, double share) {
  return map_color({false, c.light}, part_of(share));
}

ImU32 color_of(const Tokens& c, const MapCell& cell) {
  return cell.diverged ? mixed(c.ground, c.danger, 0.75f) : color_of_share(c, cell.share);
}

/// Where each zone ends, by theory; what lies between the lines depends on the shape.
void add_borders(Chart& chart, const Tokens& c, Kind kind, const MapBoundary& boundary) {
  if (boundary.dt.empty()) return;
  const auto name = [&](Zone zone, const char* side) { return std::string(zone_name(zone, kind)) + " " + side; };
  const CurveStyle rim{c.ground, LineStyle::solid, 5};  // a line of the text's color is lost on pale cells
  chart.series.push_back({"", rim, true, 0, boundary.stiffness, boundary.dt});
  chart.series.push_back(
      {name(Zone::stable, "below"), {c.text, LineStyle::solid, 2}, true, 0, boundary.stiffness, boundary.dt});
  if (kind == Kind::one_weight) return;
  ChartSeries every{name(Zone::unstable, "above"), {c.text, LineStyle::dashed, 2}, true, 0, {}, {}};
  for (std::size_t n = 0; n < boundary.every.size(); ++n)
    if (std::isfinite(boundary.every[n]))
      every.x.push_back(boundary.stiffness[n]), every.y.push_back(boundary.every[n]);
  if (every.x.empty()) return;
  chart.series.push_back({"", rim, true, 0, every.x, every.y});
  chart.series.push_back(std::move(every));
}

/// A name in the legend with a disc of its color, and nothing in the plot.
ChartSeries key(const std::string& name, ImU32 color) {
  return {name, {color, LineStyle::solid, 1}, false, 6, {}, {}};
}

}  // namespace

Chart map_chart(const Tokens& c, const Preset& preset, const MapGrid& grid, const MapBoundary& boundary,
                std::span<const MapCell> cells) {
  const std::string stiffness = stiffness_key(preset);
  Chart chart;
  chart.x = {stiffness + ", N/m", true, false, {}, {{grid.least_stiffness, grid.most_stiffness}}};
  chart.y = {"dt, s", true, false, {}, {{grid.least_dt, grid.most_dt}}};
  for (const MapCell& cell : cells)
    chart.cells.push_back({grid.stiffness(cell.column), grid.stiffness(cell.column + 1), grid.dt(cell.row),
                           grid.dt(cell.row + 1), color_of(c, cell), cell.diverged});
  add_borders(chart, c, preset.kind, boundary);
  chart.series.push_back({"", {c.ground, LineStyle::solid, 1}, false, 8, {stiffness_of(preset)}, {preset.dt}});
  chart.series.push_back({"now", {c.sky, LineStyle::solid, 1}, false, 6, {stiffness_of(preset)}, {preset.dt}});
  chart.series.push_back(key("diverged", color_of(c, {.diverged = true})));
  chart.series.push_back(key("energy error 10⁻⁶", color_of_share(c, 1e-6)));
  chart.series.push_back(key("error 10⁻³", color_of_share(c, 1e-3)));
  chart.series.push_back(key("error 1", color_of_share(c, 1)));
  return chart;
}

Chart map_page(const Tokens& c, const Preset& preset, const std::string& label, const std::string& note,
               const MapGrid& grid, const MapBoundary& boundary, std::span<const MapCell> cells) {
  Chart chart = map_chart(c, preset, grid, boundary, cells);
  chart.title = "Which " + stiffness_key(preset) + " and dt " + std::string(scheme(preset.integrator).title) +
                " tolerates: " + label;
  chart.note = note;
  return chart;
}

std::string cell_words(const Preset& preset, const MapCell& cell) {
  std::string text =
      stiffness_key(preset) + " = " + quantity(cell.stiffness, "N/m", 2) + ", dt = " + quantity(cell.dt, "s", 2) + ": ";
  if (cell.diverged) return text + "diverged after " + quantity(cell.t, "s", 2);
  return text + (cell.share < 0 ? "removed " : "added ") + power_number(100 * std::abs(cell.share), 2) +
         " % of the scene's energy in " + quantity(cell.t, "s", 2);
}

}  // namespace tyglab
