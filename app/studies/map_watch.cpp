#include "app/studies/map_watch.h"

namespace tyglab {
namespace {

bool holds(const MapGrid& grid, const Preset& preset) {
  const double stiffness = stiffness_of(preset);
  return stiffness >= grid.least_stiffness && stiffness <= grid.most_stiffness && preset.dt >= grid.least_dt &&
         preset.dt <= grid.most_dt;
}

void fill(Study<MapFindings>::Shared& shared, const Preset& of, const MapGrid& grid, const JobControl& control) {
  try {
    MapBoundary boundary = map_boundary(of, grid);
    shared.update([&](MapFindings& map) { map.boundary = std::move(boundary); });
    for (const int n : coarse_first(grid)) {
      const MapCell cell =
          measure_cell(of, grid, n % grid.columns, n / grid.columns, [&] { return control.cancelled(); });
      shared.update([&](MapFindings& map) { map.cells.push_back(cell); });
    }
  } catch (const Stopped&) {
  } catch (const std::exception& error) {
    shared.update([&](MapFindings& map) { map.problem = error.what(); });
  }
}

}  // namespace

void MapWatch::drop() {
  work_.drop();
  changed_ = -1;
}

std::optional<MapFindings> MapWatch::findings() const {
  return work_.findings();
}

void MapWatch::begin(const StudyMoment& moment) {
  changed_ = -1;
  const Preset& of = moment.preset();
  const MapGrid grid = map_grid(of, columns, rows);
  work_.begin({of, grid, {}, {}, {}},
              [of, grid](Work::Shared& shared, const JobControl& control) { fill(shared, of, grid, control); });
}

void MapWatch::poll(StudyMoment& moment) {
  if (moment.simulation.lattice().size() > largest || !map_problem(moment.preset()).empty()) return drop();
  const auto known = findings();
  const bool fits = known && same_map(known->of, moment.preset()) && holds(known->grid, moment.preset());
  if (fits) {
    changed_ = -1;
    return work_.working() ? moment.ask_again_in(0.15) : void();
  }
  work_.cancel();
  if (changed_ < 0) changed_ = moment.now;
  if (!work_.working() && (!known || moment.settled(changed_)) && !moment.dragging) begin(moment);
  moment.ask_again_in(0.1);
}

}  // namespace tyglab
