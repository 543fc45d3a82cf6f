#include "app/ui/cards/cards.h"

#include <algorithm>
#include <cmath>

#include "app/base/text.h"
#include "app/ui/kit/chart.h"
#include "app/ui/kit/imgui_compat.h"
#include "app/ui/kit/widgets.h"
#include "core/theory/zones.h"

namespace tyglab {
namespace {

/// The place under a pixel: columns and rows of the grid from its beginning; none outside.
std::optional<ImVec2> place_at(const PlotAxes& axes, const MapGrid& grid, ImVec2 pixel) {
  const float x = (pixel.x - axes.lo.x) / (axes.hi.x - axes.lo.x), y = (axes.hi.y - pixel.y) / (axes.hi.y - axes.lo.y);
  if (x < 0 || y < 0 || x >= 1 || y >= 1) return std::nullopt;
  return ImVec2{x * float(grid.columns), y * float(grid.rows)};
}

const MapCell* cell_at(const MapFindings& map, ImVec2 place) {
  const auto found = std::find_if(map.cells.begin(), map.cells.end(), [&](const MapCell& cell) {
    return cell.column == int(place.x) && cell.row == int(place.y);
  });
  return found == map.cells.end() ? nullptr : &*found;
}

void take_place(Ui& ui, const MapGrid& grid, ImVec2 place) {
  Preset next =
      at_place(ui.session.requested_preset(), rounded(grid.stiffness(place.x), 2), rounded(grid.dt(place.y), 2));
  ui.session.propose(std::move(next));
}

void words_alone(Ui& ui, const std::string& words) {
  ImGui::PushTextWrapPos(0);
  wrapped(ui, words, ui.theme.colors.text);
  ImGui::PopTextWrapPos();
}

}  // namespace

void stability_map(Ui& ui, ImVec2 size) {
  if (ui.session.simulation->lattice().size() > MapWatch::largest)
    return words_alone(ui, "This cloth is too large to be mapped here.");
  if (const std::string problem = map_problem(ui.session.requested_preset()); !problem.empty())
    return words_alone(ui, problem + ".");
  const auto map = ui.session.studies.map.findings();
  if (!map) return;
  if (!map->problem.empty()) return words_alone(ui, "The map stopped here: " + map->problem);
  const Preset present =
      at_place(map->of, stiffness_of(ui.session.requested_preset()), ui.session.requested_preset().dt);
  Chart chart = map_chart(ui.theme.colors, present, map->grid, map->boundary, map->cells);
  chart.padding = 0;
  const ImVec2 lo = ImGui::GetCursorScreenPos();
  const PlotAxes axes = draw_chart({*ImGui::GetWindowDrawList(), ui.theme, ui.fonts}, lo, size, chart);
  ImGui::SetCursorScreenPos(axes.lo);
  const bool clicked =
      gui::press_area("map", {std::max(axes.hi.x - axes.lo.x, 1.f), std::max(axes.hi.y - axes.lo.y, 1.f)});
  report_control(ui, "map");
  const auto place = place_at(axes, map->grid, ImGui::GetIO().MousePos);
  if (!place || !ImGui::IsItemHovered()) return;
  if (clicked) take_place(ui, map->grid, *place);
  begin_tooltip_at_pointer(ui);
  const MapCell* cell = cell_at(*map, *place);
  wrapped(ui, cell != nullptr ? cell_words(map->of, *cell) + "." : "This run has not been computed yet.",
          ui.theme.colors.text);
  const Zone zone = zone_of(at_place(map->of, map->grid.stiffness(place->x), map->grid.dt(place->y)));
  if (!map->boundary.dt.empty())
    wrapped(ui, "In linear theory: " + std::string(zone_name(zone, map->of.kind)) + ".", ui.theme.colors.text);
  wrapped(ui, "Click to use these values.", ui.theme.colors.quiet);
  end_tooltip(ui);
}

}  // namespace tyglab
