#include "app/studies/map_watch.h"

#include <algorithm>

#include "app/ui/app.h"

namespace tyglab {
namespace {

constexpr double map_settles = 0.3;  // s after the last change of constants

/// Constants without what the map has on its axes, and without what no motion depends on.
Preset mapped(Preset preset) {
  preset.k_s = preset.k = preset.dt = 1;
  return moving(std::move(preset));
}

bool holds(const MapGrid& grid, const Preset& preset) {
  const double stiffness = stiffness_of(preset);
  return stiffness >= grid.least_stiffness && stiffness <= grid.most_stiffness && preset.dt >= grid.least_dt &&
         preset.dt <= grid.most_dt;
}

void fill(Background<MapFindings>::Shared& shared) {
  const MapFindings begun = shared.findings();
  try {
    MapBoundary boundary = map_boundary(begun.of, begun.grid);
    shared.tell([&](MapFindings& map) { map.boundary = std::move(boundary); });
    for (const int n : coarse_first(begun.grid)) {
      const MapCell cell = measure_cell(begun.of, begun.grid, n % begun.grid.columns, n / begun.grid.columns,
                                        [&] { return shared.stopped(); });
      shared.tell([&](MapFindings& map) { map.cells.push_back(cell); });
    }
  } catch (const Stopped&) {
  } catch (const std::exception& error) {
    shared.tell([&](MapFindings& map) { map.problem = error.what(); });
  }
}

}  // namespace

void MapWatch::drop() {
  work_.drop();
  changed_ = -1;
}

std::optional<MapFindings> MapWatch::findings() const {
  return work_.shared() ? std::optional(work_.shared()->findings()) : std::nullopt;
}

void MapWatch::begin(App& app) {
  changed_ = -1;
  work_.begin({app.preset(), map_grid(app.preset(), columns, rows), {}, {}, {}}, fill);
}

void MapWatch::poll(App& app) {
  const auto soon = [&](double wait) { app.ui.draw_by = std::min(app.ui.draw_by, app.ui.now + wait); };
  if (app.simulation->lattice().size() > largest) return drop();
  const auto known = findings();
  const bool fits = known && mapped(known->of) == mapped(app.preset()) && holds(known->grid, app.preset());
  if (fits) {
    changed_ = -1;
    return work_.busy() ? soon(0.15) : void();
  }
  work_.stop();
  if (changed_ < 0) changed_ = app.ui.now;
  const bool settled = !known || app.ui.now >= std::max(changed_, app.ui.last_change) + map_settles;
  if (!work_.busy() && settled && app.ui.slider.dragged == 0) begin(app);
  soon(0.1);
}

}  // namespace tyglab
