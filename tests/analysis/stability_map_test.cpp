// The map of stiffness against dt: where cells diverge is where theory says, and the grid holds what is set.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/analysis/stability_map.h"
#include "tests/support/scenes.h"

namespace tyglab::stability_map_test {

const Stop never = [] { return false; };

TEST_CASE("a map holds the preset's own values, and its cells fill it in equal steps of logarithms") {
  for (const char* integrator : {"verlet", "implicit_euler", "euler", "xpbd"}) {
    CAPTURE(std::string(integrator));
    const Preset preset = test::cloth(6, 6, integrator);
    const MapGrid grid = map_grid(preset, 12, 9);
    CHECK(grid.least_stiffness < preset.k_s);
    CHECK(grid.most_stiffness > preset.k_s);
    CHECK(grid.least_dt < preset.dt);
    CHECK(grid.most_dt > preset.dt);
    CHECK(grid.stiffness(0) == doctest::Approx(grid.least_stiffness));
    CHECK(grid.dt(9) == doctest::Approx(grid.most_dt));
    CHECK(grid.dt(4) / grid.dt(3) == doctest::Approx(grid.dt(8) / grid.dt(7)));
  }
}

TEST_CASE("every cell comes once, the first ones far apart") {
  const MapGrid grid = map_grid(test::cloth(6, 6), 13, 7);
  const std::vector<int> order = coarse_first(grid);
  CHECK(std::set<int>(order.begin(), order.end()).size() == 13 * 7);
  CHECK(order.size() == 13 * 7);
  CHECK(std::abs(order[0] % 13 - order[1] % 13) >= 4);
}

TEST_CASE("Verlet's cells are bounded below the boundary of theory and diverge well above it") {
  Preset preset = test::cloth(8, 8);
  preset.k_b = 0, preset.k_d = 0;
  const MapGrid grid = map_grid(preset, 6, 10);
  const MapBoundary boundary = map_boundary(preset, grid);
  REQUIRE(boundary.dt.size() > 60);
  // ω² = 12 k_s/m, ω·dt = 2.
  for (std::size_t n = 0; n < boundary.dt.size(); n += 7)
    CHECK(boundary.dt[n] == doctest::Approx(2 / std::sqrt(12 * boundary.stiffness[n] / preset.m)).epsilon(1e-3));
  int below = 0, above = 0;
  for (int column = 0; column < grid.columns; ++column)
    for (int row = 0; row < grid.rows; ++row) {
      const MapCell cell = measure_cell(preset, grid, column, row, never);
      const double over = cell.dt / (2 / std::sqrt(12 * cell.stiffness / preset.m));
      CAPTURE(over);
      CAPTURE(cell.stiffness);
      const bool under = over < 0.95;
      const bool beyond = over > 3;
      below += under;
      above += beyond;
      if (under) CHECK_FALSE(cell.diverged);
      if (beyond) CHECK(cell.diverged);
      if (!cell.diverged && over < 0.3) CHECK(std::abs(cell.share) < 0.02);
    }
  CHECK(below > 10);
  CHECK(above > 10);
}

TEST_CASE("implicit Euler has no boundary, and nothing of it diverges; one weight has k on its axis") {
  const Preset preset = test::cloth(5, 5, "implicit_euler");
  const MapGrid grid = map_grid(preset, 3, 3);
  CHECK(map_boundary(preset, grid).dt.empty());
  for (int n = 0; n < grid.size(); ++n) CHECK_FALSE(measure_cell(preset, grid, n % 3, n / 3, never).diverged);
  const Preset weight = test::one_weight();
  CHECK(stiffness_key(weight) == "k");
  const MapGrid own = map_grid(weight, 5, 5);
  CHECK(at_place(weight, 7, 0.01).k == 7);
  CHECK_FALSE(measure_cell(weight, own, 0, 0, never).diverged);
  CHECK(measure_cell(weight, own, 4, 4, never).diverged);
}

TEST_CASE("there is no map over a k_s that acts on nothing") {
  Preset preset = test::cloth(6, 6);
  preset.k_warp = preset.k_weft = 80;
  CHECK(map_problem(preset).empty());
  preset.k_shear = 0;
  CHECK(map_problem(preset) ==
        "k_s has no effect while k_warp, k_weft and k_shear are set, so there is no map over it");
  CHECK(map_problem(test::one_weight()).empty());
}

TEST_CASE("a map that is asked to stop stops") {
  const Preset preset = test::cloth(6, 6);
  CHECK_THROWS_AS(measure_cell(preset, map_grid(preset, 2, 2), 0, 0, [] { return true; }), Stopped);
}

TEST_CASE("a cell is asked in every step whether to stop: a single one may be costly") {
  Preset preset = test::cloth(12, 12, "projective_dynamics");
  preset.iterations = 50;
  const MapGrid grid = map_grid(preset, 4, 4);
  int asked = 0;
  const MapCell cell = measure_cell(preset, grid, 2, 2, [&] { return ++asked < 0; });
  CHECK(asked >= std::floor(cell.t / cell.dt));
  CHECK_THROWS_AS(measure_cell(preset, grid, 2, 2, [left = 5]() mutable { return --left < 0; }), Stopped);
}

TEST_CASE("a map's CSV has a row a cell with its units") {
  const Preset preset = test::cloth(5, 5);
  const MapGrid grid = map_grid(preset, 2, 2);
  std::vector<MapCell> cells;
  for (const int n : coarse_first(grid)) cells.push_back(measure_cell(preset, grid, n % 2, n / 2, never));
  const std::string text = map_csv(preset, cells);
  CHECK(std::count(text.begin(), text.end(), '\n') == 6);
  CHECK(text.find("k_s [N/m],dt [s],outcome,t [s],energy error,dt by theory [s]\n") != std::string::npos);
  CHECK(text.find(",diverged,") != std::string::npos);
  CHECK(text.find(",bounded,") != std::string::npos);
  for (const MapCell& cell : cells)
    CHECK(cell.dt_theory == doctest::Approx(map_limit(at_place(preset, cell.stiffness, cell.dt))));
}

TEST_CASE("a map stays as it is while stiffness, dt, looks and the engine change, and no longer") {
  for (const Preset& of : {test::cloth(6, 6), test::one_weight()}) {
    const auto stays = [&](auto change) {
      Preset next = of;
      change(next);
      return same_map(of, next) && same_map(next, of);
    };
    const bool cloth = of.kind == Kind::cloth;
    CHECK(stays([](Preset& p) { p.dt /= 3; }));
    CHECK(stays([](Preset& p) { p.k_s *= 2, p.k *= 3; }));
    CHECK(stays([](Preset& p) { p.mode = 2, p.texture = "a", p.name = "b", p.description = "c"; }));
    CHECK(stays([](Preset& p) { p.engine = EngineKind::opencl, p.device = 1; }));
    CHECK(stays([](Preset& p) { p.k_b += 1; }) == !cloth);
    CHECK_FALSE(stays([](Preset& p) { p.k_d += 1; }));
    CHECK_FALSE(stays([](Preset& p) { p.precision = Precision::float_; }));
    CHECK_FALSE(stays([](Preset& p) { p.integrator = "rk4"; }));
    CHECK_FALSE(stays([](Preset& p) { p.x_0.y += 1; }));
    CHECK_FALSE(stays([cloth](Preset& p) { p.kind = cloth ? Kind::one_weight : Kind::cloth; }));
  }
}

}  // namespace tyglab::stability_map_test
