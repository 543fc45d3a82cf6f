// Figure 3.2 live: what moves beside the one weight.
#include "app/session/recorded.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/analysis/one_weight.h"
#include "tests/support/scenes.h"

namespace tyglab::figure_test {

TEST_CASE("companions are the report's methods from the same start, the last the closed form") {
  for (const char* method : {"verlet", "rk4", "euler"}) {
    Preset preset = test::one_weight(method);
    Simulation weight(preset);
    ReferenceCurves figure;
    ReferenceCurves::Heights y = figure.follow(weight, 0);
    for (const double height : y) CHECK(height == doctest::Approx(weight.positions().at(0, 0).y));
    for (int n = 0; n < 10; ++n) weight.advance(7), y = figure.follow(weight, 7);
    for (std::size_t k = 0; k + 1 < y.size(); ++k) {
      preset.integrator = ReferenceCurves::curves[k];
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
  ReferenceCurves figure;
  weight.advance(300), figure.follow(weight, 300);
  preset.k *= 2, preset.k_d = 0.001, preset.dt = 5e-4, preset.g = 3;
  weight.apply(edit::Change{preset});
  weight.advance(500);
  const ReferenceCurves::Heights y = figure.follow(weight, 500);
  // rk4 is exact to many digits here, so the closed form must be where it is.
  CHECK(y.back() == doctest::Approx(weight.positions().at(0, 0).y).epsilon(1e-7));
  weight.apply(edit::Restart{});
  for (const double height : figure.follow(weight, 0)) CHECK(height == doctest::Approx(weight.positions().at(0, 0).y));
}

TEST_CASE("where the weight has moved unseen they begin anew from where it is") {
  Preset preset = test::one_weight("rk4");
  preset.dt = 1e-3;
  Simulation weight(preset);
  ReferenceCurves figure;
  weight.advance(100), figure.follow(weight, 100);
  weight.advance(150);  // the plot is hidden
  preset.k *= 3;
  weight.apply(edit::Change{preset});
  weight.advance(170);
  weight.advance(5);
  for (const double height : figure.follow(weight, 5)) CHECK(height == doctest::Approx(weight.positions().at(0, 0).y));
  weight.advance(400);
  CHECK(figure.follow(weight, 400).back() == doctest::Approx(weight.positions().at(0, 0).y).epsilon(1e-7));
}

TEST_CASE("they begin where no preset lets a weight start") {
  Preset preset = test::one_weight("rk4");
  preset.dt = 1e-3, preset.v_0.y = 1000, preset.k = 1e-3, preset.L = 10;
  Simulation weight(preset);
  ReferenceCurves figure;
  weight.advance(2000);
  weight.advance(1);
  for (const double height : figure.follow(weight, 1)) CHECK(height == doctest::Approx(weight.positions().at(0, 0).y));
  CHECK(weight.positions().at(0, 0).y > 1500);
  weight.advance(400);
  CHECK(figure.follow(weight, 400).back() == doctest::Approx(weight.positions().at(0, 0).y).epsilon(1e-7));
}

TEST_CASE("a companion that has diverged has no height any more") {
  Preset preset = test::one_weight("implicit_euler");
  preset.dt = 0.2;
  Simulation weight(preset);
  ReferenceCurves figure;
  weight.advance(2000);
  const ReferenceCurves::Heights y = figure.follow(weight, 2000);
  CHECK(std::isnan(y[0]));
  CHECK(std::isfinite(y.back()));
}

}  // namespace tyglab::figure_test
