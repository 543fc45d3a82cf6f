// The closed form of one weight, and runs beside it.
#include "core/analysis/one_weight.h"

#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "tests/support/scenes.h"

namespace tyglab::one_weight_test {

/// Without gravity, from rest at `offset`.
Preset oscillator(const std::string& integrator, double dt) {
  Preset preset = test::one_weight(integrator);
  preset.g = 0, preset.dt = dt;
  return preset;
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

}  // namespace tyglab::one_weight_test
