// What studies try of the dt that a preset may have goes beyond it: at both ends of the range they finish, with the
// library's assertions on too.
#include <doctest/doctest.h>

#include "core/analysis/convergence.h"
#include "core/analysis/settings_search.h"
#include "core/analysis/stability_map.h"
#include "tests/support/scenes.h"

namespace tyglab::study_steps_test {

const Stop never = [] { return false; };

Preset small(double dt) {
  Preset preset = test::cloth(2, 2, "verlet");
  preset.dt = dt;
  return preset;
}

Preset slow_weight(const std::string& integrator) {
  Preset preset = small(1);
  preset.kind = Kind::one_weight, preset.integrator = integrator;
  preset.m = 100, preset.k = 0.01;
  return preset;
}

TEST_CASE("the order of convergence is measured at both ends of dt's range") {
  for (const Preset& preset :
       {small(1e-7), small(1), slow_weight("verlet"), slow_weight("dopri5"), slow_weight("implicit_euler")}) {
    CAPTURE(preset.dt);
    CAPTURE(preset.integrator);
    Convergence last;
    measure_convergence({preset, std::nullopt}, 20 * preset.dt, {.reference = 1e6, .point = 1e5}, never,
                        [&](const Convergence& now) { last = now; });
    CHECK(last.done);
  }
}

TEST_CASE("cells of a map at both ends of dt's range are measured") {
  for (const Preset& preset : {small(1e-7), small(1), slow_weight("verlet")}) {
    const MapGrid grid = map_grid(preset, 2, 2);
    for (const int cell : coarse_first(grid))
      CHECK(measure_cell(preset, grid, cell % grid.columns, cell / grid.columns, never).t > 0);
  }
}

}  // namespace tyglab::study_steps_test
