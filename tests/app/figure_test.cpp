// Figure 3.2 live: what moves beside the one weight.
#include "app/sandbox/figure.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/analysis/one_weight.h"
#include "tests/support/scenes.h"

namespace tyglab {
namespace {

TEST_CASE("companions are the report's methods from the same start, the last the closed form") {
  for (const char* method : {"verlet", "rk4", "euler"}) {
    Preset preset = test::one_weight(method);
    Simulation weight(preset);
    Figure figure;
    Figure::Heights y = figure.follow(weight);
    for (const double height : y) CHECK(height == doctest::Approx(weight.positions().at(0, 0).y));
    for (int n = 0; n < 10; ++n) weight.advance(7), y = figure.follow(weight);
    for (std::size_t k = 0; k + 1 < y.size(); ++k) {
      preset.integrator = Figure::curves[k];
      Simulation alone(preset);
      alone.advance(70);
      CHECK(y[k] == alone.positions().at(0, 0).y);
    }
    CHECK(y.back() == doctest::Approx(exact_weight(preset, weight.time()).y).epsilon(1e-12));
  }
}

TEST_CASE("they follow constants that change in mid-run, dt too, and begin anew after a restart") {
  Preset preset = test::one_weight("rk4");
  preset.dt = 1e-3;
  Simulation weight(preset);
  Figure figure;
  figure.follow(weight);
  weight.advance(300), figure.follow(weight);
  preset.k *= 2, preset.k_d = 0.001, preset.dt = 5e-4, preset.g = 3;
  weight.apply(edit::Change{preset});
  weight.advance(500);
  const Figure::Heights y = figure.follow(weight);
  // rk4 is exact to many digits here, so the closed form must be where it is.
  CHECK(y.back() == doctest::Approx(weight.positions().at(0, 0).y).epsilon(1e-7));
  weight.apply(edit::Restart{});
  for (const double height : figure.follow(weight)) CHECK(height == doctest::Approx(weight.positions().at(0, 0).y));
}

TEST_CASE("a companion that has diverged has no height any more") {
  Preset preset = test::one_weight("implicit_euler");
  preset.dt = 0.2;
  Simulation weight(preset);
  Figure figure;
  figure.follow(weight);
  weight.advance(2000);
  const Figure::Heights y = figure.follow(weight);
  CHECK(std::isnan(y[0]));
  CHECK(std::isfinite(y.back()));
}

}  // namespace
}  // namespace tyglab
