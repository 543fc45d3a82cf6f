// Errors of the motion at hand, and settings chosen by them.
#include "core/analysis/tolerance.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/analysis/one_weight.h"
#include "core/io/preset_io.h"
#include "tests/support/places.h"
#include "tests/support/sanitized.h"
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

TEST_CASE("a setting that takes longer than it may is given up, and errs without bound") {
  const StudyStart start{test::cloth(16, 16, "rk4"), std::nullopt};
  const StudyReference reference = study_reference(start, 0.2, {}, never);
  StudyStart slow = start;
  slow.preset.dt = 1e-6;
  const ErrorPoint point = measure_point(slow, reference, never, 0.01);
  CHECK(point.given_up);
  CHECK(std::isinf(point.error_rms_m));
  CHECK_FALSE(measure_point(start, reference, never).given_up);
}

ToleranceChoice choose(const Preset& preset, const SettingsGoal& goal) {
  return choose_for_tolerance(preset, goal, never, [](const SettingsSearch&) {});
}

TEST_CASE("the chosen settings keep the tolerance, by the closed form") {
  for (const double tolerance : {1e-3, 1e-5, 1e-8}) {
    CAPTURE(tolerance);
    const ToleranceChoice choice = choose(swinging_weight("euler", 0.01), {.tolerance = tolerance});
    CHECK(choice.preset.integrator == choice.chosen.integrator);
    CHECK(choice.chosen.cost == choice.reached.front().cost);
    CHECK(choice.seconds == 1);
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
  const auto chosen = [&](double tolerance, bool integrator, bool precision) {
    return choose(cloth, {.tolerance = tolerance, .seconds = 0.1, .keeps = {integrator, precision}});
  };
  CHECK(chosen(1e-4, true, false).preset.integrator == "velocity_verlet");
  CHECK(chosen(1e-4, true, true).preset.precision == cloth.precision);
  CHECK(chosen(3e-8, false, false).preset.precision == Precision::double_);  // float does not hold it
  CHECK_THROWS_AS(chosen(3e-8, false, true), ToleranceError);
  CHECK_THROWS_AS(chosen(1e-15, false, false), ToleranceError);
  CHECK_THROWS_AS(choose_for_tolerance(
                      cloth, {}, [] { return true; }, [](const SettingsSearch&) {}),
                  Stopped);
}

/// What a search may have found: random errors of three methods, some of which failed.
SettingsSearch random_search(test::Random& random) {
  SettingsSearch known;
  const auto power = [&](double lo, double hi) { return std::pow(10, random.uniform(lo, hi)); };
  known.rough = random.below(2) == 0, known.seconds = 1;
  known.agreement_rms_m = power(-9, -2);
  for (const char* method : {"verlet", "rk4", "implicit_euler"})
    for (int n = 1 + random.below(4); n > 0; --n)
      known.points.push_back({.integrator = method,
                              .dt = 1e-3 * n,
                              .error_rms_m = power(-8, -1),
                              .cost = power(-2, 1),
                              .converged = random.below(5) > 0,
                              .given_up = random.below(9) == 0});
  return known;
}

TEST_CASE("a refusal never contradicts its figures, and what it offers can be had") {
  test::Random random(1);
  int differ = 0, best = 0;
  for (int n = 0; n < 3000; ++n) {
    const SettingsSearch known = random_search(random);
    const double tolerance = std::pow(10, random.uniform(-8, 0));
    CAPTURE(tolerance);
    try {
      reached_or_refused(known, tolerance);
    } catch (const ToleranceError& refusal) {
      const std::string words = refusal.what();
      CAPTURE(words);
      const auto figure_after = [&](const char* before) {
        return std::stod(words.substr(words.find(before) + std::string(before).size()));
      };
      if (words.find("differ by ") != std::string::npos) {
        CHECK(figure_after("differ by ") * figure_after("at least ") > tolerance);
        ++differ;
      } else if (words.find("; the best was") != std::string::npos) {
        CHECK(2 * figure_after(" double with ") > tolerance);
        ++best;
      }
      if (!refusal.tightest) continue;
      CHECK(*refusal.tightest > tolerance);
      CHECK(figure_after("can be guaranteed is ") == doctest::Approx(*refusal.tightest));
      CHECK_FALSE(reached_or_refused(known, *refusal.tightest).empty());
    }
  }
  CHECK(differ > 100);
  CHECK(best > 100);
}

/// The largest error of a chosen run within the second, at twenty times, against Runge-Kutta with steps of at most
/// 2e-5 s: neither its method nor its steps are those that the choice was made by.
double error_of_choice(const Preset& chosen) {
  Preset fine = chosen;
  const int finer = int(std::ceil(chosen.dt / 2e-5));
  fine.integrator = "rk4", fine.precision = Precision::double_, fine.dt = chosen.dt / finer;
  Simulation run(chosen), exact(fine);
  const int steps = std::max(1, int(0.05 / chosen.dt));
  double worst = 0;
  for (int done = 0; (done + steps) * chosen.dt <= 1; done += steps) {
    run.advance(steps), exact.advance(steps * finer);
    if (run.divergence() || exact.divergence()) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, rms_distance({positions_of(run)}, {positions_of(exact)}));
  }
  return worst;
}

/// What was promised holds, or nothing was; and what is offered in place of a tolerance that was refused can be had.
/// Returns whether something was promised.
bool keeps_its_word(const Preset& preset, double tolerance) {
  constexpr double factor = 1;  // of the tolerance: half of it is aimed at
  try {
    const ToleranceChoice choice = choose(preset, {.tolerance = tolerance});
    CAPTURE(choice.words(tolerance));
    CHECK(choice.seconds == 1);
    CHECK(error_of_choice(choice.preset) <= factor * tolerance);
    return true;
  } catch (const ToleranceError& refusal) {
    CAPTURE(std::string(refusal.what()));
    if (!refusal.tightest) return false;
    CHECK(*refusal.tightest > tolerance);
    const ToleranceChoice offered = choose(preset, {.tolerance = *refusal.tightest});
    CAPTURE(offered.words(*refusal.tightest));
    CHECK(error_of_choice(offered.preset) <= factor * *refusal.tightest);
    return false;
  }
}

/// A cloth that falls on a sphere within the second.
Preset random_sphere(unsigned seed) {
  test::Random random(seed);
  const auto between = [&](double lo, double hi) { return random.uniform(lo, hi); };
  Preset preset = test::cloth(9, 9, "verlet");
  preset.pins.mode = Pins::Mode::none;
  preset.k_s = between(20, 200), preset.k_b = between(0, 10), preset.k_d = between(5e-4, 4e-3);
  preset.tilt_deg = between(-20, 20);
  preset.x_0 = {0, 0.5, -0.12}, preset.L = 0.03;
  Body sphere;
  sphere.shape = Body::Shape::sphere;
  sphere.c = {between(-0.05, 0.05), between(0.1, 0.25), between(-0.05, 0.05)};
  sphere.r = between(0.05, 0.12), sphere.friction = between(0, 0.6), sphere.restitution = 0;
  preset.bodies = {sphere};
  return preset;
}

TEST_CASE("on a sphere the error after the impact is what was promised, or nothing was") {
  for (unsigned seed = 1; seed <= unsigned(test::fewer(5, 1)); ++seed) {
    CAPTURE(seed);
    keeps_its_word(random_sphere(seed), 1e-3);
    if (!test::sanitized) keeps_its_word(random_sphere(seed), 1e-5);
  }
}

TEST_CASE("free fall is certified where the run ends before the impact, and nowhere else") {
  const Preset preset = random_sphere(3);
  const ToleranceChoice fall = choose(preset, {.tolerance = 1e-5, .seconds = 0.1});
  CHECK(fall.seconds == 0.1);
  CHECK_THROWS_AS(choose(preset, {.tolerance = 1e-7}), ToleranceError);
}

TEST_CASE("the shipped presets, with fewer particles: what is promised holds") {
  const std::vector<std::string> names{"sphere",  "hanging",       "one_weight", "denim",     "flag",
                                       "tearing", "fold_with_k_b", "rubber_mat", "taut_sheet"};
  int promised = 0, tried = 0;
  for (; tried < test::fewer(int(names.size()), 2); ++tried) {
    const std::string& name = names[std::size_t(tried)];
    CAPTURE(name);
    Preset preset = load_preset(std::string(test::source_dir) + "/app/presets/" + name + ".json");
    if (preset.kind == Kind::cloth && preset.pins.mode != Pins::Mode::list) preset.rows = preset.columns = 9;
    promised += keeps_its_word(preset, 1e-3);
  }
  CHECK(promised >= tried - 3);
}

}  // namespace tyglab::tolerance_test
