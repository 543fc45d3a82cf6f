// Errors of the motion at hand, and settings chosen by them.
#include "core/analysis/tolerance.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/analysis/one_weight.h"
#include "tests/support/scenes.h"

namespace tyglab::tolerance_test {

const Stop never = [] { return false; };

Preset swinging_weight(const char* method, double dt) {
  Preset preset = test::one_weight(method);
  preset.dt = dt, preset.precision = Precision::double_;
  return preset;
}

/// Its error by the closed form, at the times at which a study compares.
double exact_error(const Preset& preset, double seconds) {
  Simulation weight(preset);
  double squares = 0;
  for (int n = 1; n <= accuracy_samples; ++n) {
    weight.advance(int(std::lround(seconds / accuracy_samples / preset.dt)));
    squares += std::pow(weight.positions().at(0, 0).y - exact_weight(preset, seconds * n / accuracy_samples).y, 2);
  }
  return std::sqrt(squares / accuracy_samples);
}

TEST_CASE("the estimated error of one weight is that by its closed form, for every method") {
  for (const char* method : {"euler", "verlet", "rk4", "implicit_euler", "tr_bdf2"}) {
    CAPTURE(method);
    const Preset preset = swinging_weight(method, 0.004);
    const StudyStart start{preset, std::nullopt};
    const StudyReference reference = study_reference(start, 1, {}, never);
    CHECK(reference.seconds == doctest::Approx(0.992));  // a whole number of steps between samples
    const ErrorPoint point = measure_point(start, reference, never);
    CHECK(point.resolved);
    CHECK(point.error_rms_m == doctest::Approx(exact_error(preset, reference.seconds)).epsilon(1e-3));
    CHECK(point.cost > 0);
  }
}

TEST_CASE("a study begins at a snapshot where it is given one") {
  Preset preset = test::cloth(8, 8, "verlet");
  preset.dt = 5e-4;
  Simulation simulation(preset);
  simulation.advance(400);
  const StudyStart now{preset, simulation.snapshot()};
  const StudyReference reference = study_reference(now, 0.01, {}, never);
  simulation.advance(int(std::lround(reference.seconds / preset.dt)));
  const Track end{positions_of(simulation)};
  CHECK(rms_distance({reference.track.back()}, end) < 1e-4);
  CHECK(measure_point(now, reference, never).error_rms_m < 1e-4);
  const StudyStart first{preset, std::nullopt};
  CHECK(measure_point(first, reference, never).error_rms_m > 1e-3);
}

TEST_CASE("a setting that diverges errs without bound, and costs no search") {
  Preset preset = test::cloth(8, 8, "verlet");
  const StudyStart start{preset, std::nullopt};
  const StudyReference reference = study_reference(start, 0.2, {}, never);
  Preset wild = preset;
  wild.dt = 0.02;
  CHECK(std::isinf(measure_point({wild, std::nullopt}, reference, never).error_rms_m));
}

TEST_CASE("a ladder's errors fall by the method's order until they are small enough") {
  const StudyStart start{swinging_weight("velocity_verlet", 0.01), std::nullopt};
  const StudyReference reference = study_reference(start, 1, {}, never);
  const std::vector<ErrorPoint> ladder = error_ladder(start, reference, 1e-7, {}, never);
  REQUIRE(ladder.size() > 4);
  const std::size_t n = ladder.size() - 2;
  CHECK(std::log2(ladder[n - 1].error_rms_m / ladder[n].error_rms_m) == doctest::Approx(2).epsilon(0.05));
  CHECK(ladder.back().error_rms_m <= 1e-7);
  CHECK(ladder[n].error_rms_m > 1e-7);
}

TEST_CASE("the chosen settings keep the tolerance, by the closed form") {
  for (const double tolerance : {1e-3, 1e-5, 1e-8}) {
    CAPTURE(tolerance);
    const ToleranceChoice choice = choose_for_tolerance(swinging_weight("euler", 0.01), tolerance, 1, {}, never);
    CHECK(choice.preset.integrator == choice.chosen.integrator);
    CHECK(choice.chosen.cost == choice.reached.front().cost);
    Preset preset = choice.preset;
    if (preset.integrator == "dopri5") continue;  // its dt is no step
    CHECK(preset.dt <= choice.chosen.dt);
    CHECK(preset.dt > 0.9 * choice.chosen.dt);
    preset.dt = choice.chosen.dt;                                        // as it was measured
    const double steps = choice.seconds / accuracy_samples / preset.dt;  // between two samples
    CHECK(steps == doctest::Approx(std::round(steps)).epsilon(1e-9));
    CHECK(exact_error(preset, choice.seconds) < 0.51 * tolerance);
  }
}

TEST_CASE("what was typed stays, and what cannot be reached is refused with a reason") {
  Preset cloth = test::cloth(8, 8, "velocity_verlet");
  cloth.precision = Precision::float_;
  const auto choose = [&](double tolerance, bool integrator, bool precision) {
    return choose_for_tolerance(cloth, tolerance, 0.1, {integrator, precision}, never);
  };
  CHECK(choose(1e-4, true, false).preset.integrator == "velocity_verlet");
  CHECK(choose(1e-4, true, true).preset.precision == cloth.precision);
  CHECK(choose(3e-8, false, false).preset.precision == Precision::double_);  // float does not hold it
  CHECK_THROWS_AS(choose(3e-8, false, true), ToleranceError);
  CHECK_THROWS_AS(choose(1e-15, false, false), ToleranceError);
  CHECK_THROWS_AS(choose_for_tolerance(cloth, 1e-4, 0.1, {}, [] { return true; }), Stopped);
}

}  // namespace tyglab::tolerance_test
