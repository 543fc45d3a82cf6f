// The closed form of one weight, and the frequency and decay that each method makes of it.
#include "core/analysis/one_weight.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/support/scenes.h"

namespace tyglab::one_weight_test {

/// Without gravity, from rest at `offset`.
Preset oscillator(const std::string& integrator, double dt) {
  Preset preset = test::one_weight(integrator);
  preset.g = 0, preset.dt = dt;
  return preset;
}

double omega(const Preset& preset) {
  return std::sqrt(preset.k / preset.m);
}

TEST_CASE("the closed form satisfies its equation of motion, damped in every way") {
  for (const double k : {0.0, 1e-3, 40.0})
    for (const double k_d : {0.0, 1e-9, 0.2, 4.0, 400.0}) {
      CAPTURE(k);
      CAPTURE(k_d);
      Preset preset = test::one_weight();
      preset.k = k, preset.k_d = k_d;  // 4 is critical at k = 40
      preset.v_0 = {0, 0.7, 0};
      const WeightMotion start = exact_weight(preset, 0);
      CHECK(start.y == doctest::Approx(preset.x_0.y + preset.offset));
      CHECK(start.v == doctest::Approx(preset.v_0.y));
      for (const double t : {0.01, 0.3, 2.0}) {
        const double h = 1e-4;
        const WeightMotion at = exact_weight(preset, t), before = exact_weight(preset, t - h),
                           after = exact_weight(preset, t + h);
        const double a = (-preset.k * (at.y - preset.x_0.y) - preset.k_d * at.v) / preset.m - preset.g;
        CHECK((after.y - before.y) / (2 * h) == doctest::Approx(at.v).epsilon(1e-3));
        CHECK((after.v - before.v) / (2 * h) == doctest::Approx(a).epsilon(1e-3).scale(10));
      }
    }
}

TEST_CASE("the closed form is what a fine Runge-Kutta finds") {
  for (const double k_d : {0.0, 0.2, 4.0, 40.0}) {
    CAPTURE(k_d);
    Preset preset = test::one_weight("rk4");
    preset.k_d = k_d, preset.dt = 1e-4;
    const WeightRun run = run_weight(preset, 5000, [] { return false; });
    CHECK(run.error_largest_m < 1e-10);
    CHECK(run.error_rms_m <= run.error_largest_m);
    CHECK_FALSE(run.diverged);
    CHECK(run.t.size() == 5001);
  }
}

TEST_CASE("a run that diverges says so, and one that is stopped ends") {
  Preset preset = oscillator("verlet", 0.5);
  CHECK(run_weight(preset, 1000, [] { return false; }).diverged);
  CHECK(run_weight(preset, 1000, [] { return true; }).t.empty());
}

/// The phase (rad) and growth of one step, from y at three neighboring steps far from the start: y = r^n cos(n φ + c).
struct StepFactor {
  double phase, growth;
};

StepFactor factor(const Preset& preset) {
  Simulation simulation(preset);
  simulation.advance(40);
  double y[4];
  for (double& value : y) {
    value = simulation.positions().at(0, 0).y - preset.x_0.y;
    simulation.advance(1);
  }
  // y[n+1] = p y[n] - q y[n-1], whose roots are r exp(±iφ).
  const double det = y[1] * y[1] - y[0] * y[2];
  const double p = (y[1] * y[2] - y[0] * y[3]) / det, q = (y[2] * y[2] - y[1] * y[3]) / det;
  const double growth = std::sqrt(q);
  return {std::acos(p / (2 * growth)), growth};
}

TEST_CASE("each method turns the oscillator at the frequency that is known of it") {
  for (const double h : {0.004, 0.02, 0.06}) {
    CAPTURE(h);
    for (const char* name : {"verlet", "semi_implicit_euler", "velocity_verlet"}) {
      CAPTURE(std::string(name));
      const Preset preset = oscillator(name, h);
      const StepFactor step = factor(preset);
      CHECK(step.phase == doctest::Approx(2 * std::asin(h * omega(preset) / 2)).epsilon(1e-7));
      CHECK(step.growth == doctest::Approx(1).epsilon(1e-9));
    }
    const Preset midpoint = oscillator("implicit_midpoint", h);
    const StepFactor middle = factor(midpoint);
    CHECK(middle.phase == doctest::Approx(2 * std::atan(h * omega(midpoint) / 2)).epsilon(1e-7));
    CHECK(middle.growth == doctest::Approx(1).epsilon(1e-9));
  }
}

TEST_CASE("implicit Euler decays and Euler grows by √(1 + (hω)²) a step, both late by atan(hω)") {
  for (const double h : {0.004, 0.02}) {
    CAPTURE(h);
    for (const bool implicit : {true, false}) {
      const Preset preset = oscillator(implicit ? "implicit_euler" : "euler", h);
      const double hw = h * omega(preset), growth = std::sqrt(1 + hw * hw);
      const StepFactor step = factor(preset);
      CHECK(step.phase == doctest::Approx(std::atan(hw)).epsilon(1e-7));
      CHECK(step.growth == doctest::Approx(implicit ? 1 / growth : growth).epsilon(1e-8));
    }
  }
}

}  // namespace tyglab::one_weight_test
