// How methods that choose their own steps do so: the controller alone, and what it counts in running scenes.
#include "core/integrators/step_control.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/theory/advice.h"
#include "core/theory/modes.h"
#include "tests/support/scenes.h"

namespace tyglab::step_control_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST_CASE("inner steps fill dt exactly, whatever the errors are") {
  test::Random random(3);
  StepControl control;
  control.begin(0.013);
  for (const double dt : {0.1, 1e-3, 0.7}) {
    double left = dt;
    int tries = 0;
    while (left > 0) {
      const double h = control.next(left, dt);
      CHECK(h > 0);
      CHECK(h <= left);
      if (control.judge({.error = std::pow(10.0, random.uniform(-9, -3)), .tolerance = 1e-5})) left -= h;
      REQUIRE(++tries < 100000);
    }
    CHECK(left == 0);
  }
  CHECK(control.counts().rejected > 0);
}

TEST_CASE("an error that no step mends ends at the shortest step, and is counted") {
  for (const double error : {1.0, infinity, double(NAN)}) {
    CAPTURE(error);
    StepControl control;
    control.begin(1);
    double left = 1;
    while (left > 0) {
      const double h = control.next(left, 1);
      if (control.judge({.error = error, .tolerance = 1e-6})) left -= h;
    }
    CHECK(control.counts().too_short == control.counts().accepted);
    CHECK(control.counts().accepted <= 1 / StepControl::shortest_part + 1);
    CHECK(control.counts().rejected < 100);
  }
}

TEST_CASE("steps settle where the error meets the tolerance") {
  // An error of C h^5: the controller's rest is at 0.9^(1/0.17) or so of the tolerance.
  StepControl control;
  control.begin(1e-3);
  double h = 0;
  for (int n = 0; n < 200; ++n) {
    h = control.next(1, 1);
    control.judge({.error = 1e3 * std::pow(h, 5), .tolerance = 1e-6});
  }
  CHECK(1e3 * std::pow(h, 5) < 1e-6);
  CHECK(1e3 * std::pow(h, 5) > 0.2e-6);
  CHECK(control.counts().rejected < 3);
}

TEST_CASE("no step is longer than the method's longest, and where that holds them back it is said to be stability") {
  StepControl control;
  control.set_method(3, 0.01);
  control.begin(1e-3);
  for (int n = 0; n < 100; ++n) {
    CHECK(control.next(1, 1) <= 0.0101);
    control.judge({.error = 1e-12, .tolerance = 1e-5});
  }
  CHECK(control.counts().by_stability > 90);
  CHECK(control.counts().by_stability + control.counts().by_accuracy == 100);
  // Of third order, an error of C h³ is met where it is.
  control.set_method(3, infinity);
  double h = 0;
  for (int n = 0; n < 200; ++n) {
    h = control.next(1, 1);
    control.judge({.error = 1e3 * std::pow(h, 3), .tolerance = 1e-6});
  }
  CHECK(1e3 * std::pow(h, 3) < 1e-6);
  CHECK(1e3 * std::pow(h, 3) > 0.2e-6);
}

TEST_CASE("R(z) of dopri5 is that of its table") {
  const Estimate& estimate = *scheme("dopri5").estimate;
  const double known[] = {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 600};
  REQUIRE(estimate.growth.size() == std::size(known));
  for (std::size_t n = 0; n < std::size(known); ++n) CHECK(estimate.growth[n] == doctest::Approx(known[n]));
  for (const double zeta : {0.0, 0.4, 1.0})
    for (const double h : {0.5, 1.2, 3.0}) {
      const double x = 1e-3, v = 0.2 * x;  // any motion of that oscillator fits it
      const double a = -x - 2 * zeta * v, w = -0.7 * x, b = 0.4 * x, c = -b - 2 * zeta * w;
      const StageProducts products{x * x + b * b, x * v + b * w, v * v + w * w, x * a + b * c, v * a + w * c};
      CHECK(beyond_stability(estimate, products, h) == (spectral_radius(amplification(scheme("dopri5"), h, zeta)) > 1));
    }
  // Hairer's case: a motion that decays alone.
  CHECK_FALSE(beyond_stability(estimate, {.vv = 1, .va = -1}, 3.25));
  CHECK(beyond_stability(estimate, {.vv = 1, .va = -1}, 3.32));
  CHECK_FALSE(beyond_stability(estimate, {.vv = 1, .va = 1}, 5));  // it truly grows
  CHECK_FALSE(beyond_stability(estimate, {}, 5));
}

TEST_CASE("smooth motion: few steps are rejected, and accuracy limits them") {
  Preset preset = test::one_weight("dopri5");
  preset.dt = 0.5, preset.tolerance = 1e-8;
  Simulation simulation(preset);
  simulation.advance(20);
  const InnerSteps inner = simulation.engine().inner_steps();
  CHECK(inner.accepted > 100);
  CHECK(inner.rejected < 0.05 * double(inner.accepted));
  CHECK(inner.by_accuracy == inner.accepted);
  CHECK(inner.force_evaluations == 6 * (inner.accepted + inner.rejected) + 2);
  CHECK(tolerance_missed(preset, inner).empty());
}

TEST_CASE("a stiff cloth near rest: stability limits the steps; a short dt does, and is counted so") {
  Preset preset = test::cloth(8, 8, "dopri5");
  preset.k_s = 5e4, preset.k_d = 0.05, preset.k_b = 0;
  preset.dt = 0.02, preset.tolerance = 1e-4;
  Simulation simulation(preset);
  simulation.advance(50);
  const InnerSteps early = simulation.engine().inner_steps();
  simulation.advance(100);
  const InnerSteps inner = simulation.engine().inner_steps();
  const auto accepted = double(inner.accepted - early.accepted);
  CHECK_FALSE(simulation.divergence().has_value());
  CHECK(double(inner.by_stability - early.by_stability) > 0.5 * accepted);
  preset.dt = 1e-6;
  Simulation brief(preset);
  brief.advance(50);
  CHECK(brief.engine().inner_steps().by_dt == 50);
}

TEST_CASE("in float a tolerance under the last digit ends, and is said") {
  Preset preset = test::cloth(6, 6, "dopri5");
  preset.precision = Precision::float_;
  preset.dt = 1e-3, preset.tolerance = 1e-12;
  Simulation simulation(preset);
  simulation.advance(20);
  const InnerSteps inner = simulation.engine().inner_steps();
  CHECK(inner.below_digits == inner.accepted);
  CHECK(inner.accepted < 2000);
  CHECK(tolerance_missed(preset, inner).find("below what float can resolve") != std::string::npos);
}

TEST_CASE("what no inner step is short enough for is found as a divergence, with the state before that dt") {
  Preset preset = test::cloth(6, 6, "dopri5");
  preset.k_s = 1e9, preset.dt = 1, preset.initial_stretch = 1.5;
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    preset.precision = precision;
    Preset calm = preset;
    calm.k_s = 50, calm.dt = 1e-3;
    Simulation simulation(calm);
    simulation.advance(5);
    simulation.apply(edit::Change{preset});
    const State before = simulation.read();
    CHECK(simulation.advance(3).diverged);
    CHECK(simulation.steps() == 5);
    CHECK(test::identical(simulation.read(), before));
    CHECK(simulation.divergence()->advice.find("implicit Euler") != std::string::npos);
  }
}

}  // namespace tyglab::step_control_test
