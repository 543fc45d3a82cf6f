// Steps that follow each other through the rows (waves), on one thread or several, give the bits of single steps.
#include <doctest/doctest.h>

#include "core/simulation.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::waves_test {

/// Under the sanitizers still enough for two waves.
constexpr int steps_of(int steps) {
  return test::fewer(steps, 15);
}

/// Large enough for three threads, with an odd number of rows.
Preset threads_worth(const std::string& integrator) {
  Preset preset = test::cloth(81, 72, integrator);
  preset.L = 0.01;
  preset.precision = Precision::float_;
  return preset;
}

void same_as_single_steps(const Preset& preset, int steps, int threads) {
  Simulation waves(preset, threads), single(preset);
  waves.advance(steps);
  for (int n = 0; n < steps; ++n) single.advance(1);
  CHECK(waves.engine().threads() == threads);
  CHECK(waves.steps() == single.steps());
  CHECK(waves.divergence().has_value() == single.divergence().has_value());
  CHECK(waves.tears().torn_count() == single.tears().torn_count());
  CHECK(waves.left_inside() == single.left_inside());
  CHECK(test::all_finite(waves.read()));
  CHECK(test::identical(waves.read(), single.read()));
}

TEST_CASE("waves give the bits of single steps, with every integrator" * doctest::test_suite("slow")) {
  for (const char* integrator : {"verlet", "euler", "improved_euler", "semi_implicit_euler", "velocity_verlet", "rk4",
                                 "rkn4", "force_gradient4"}) {
    CAPTURE(std::string(integrator));
    Preset preset = threads_worth(integrator);
    preset.dt = 1e-4;
    for (const int threads : {2, 3})
      if (threads == 3 || !test::sanitized) same_as_single_steps(preset, steps_of(130), threads);
    preset.precision = Precision::double_;
    same_as_single_steps(preset, steps_of(70), 3);
  }
}

TEST_CASE("waves give the bits of single steps, with whatever a scene has" * doctest::test_suite("slow")) {
  Preset preset = threads_worth("verlet");
  SUBCASE("wind and pins") {
    preset.W = {0, 1e-4, 2e-3}, preset.pins.mode = Pins::Mode::left_column;
  }
  SUBCASE("bodies") {
    preset.bodies = {Body{}, Body{.shape = Body::Shape::plane, .y = 0.7}};
    preset.bodies[0].c = {0, 0.95, 0.05}, preset.bodies[0].r = 0.1;
  }
  SUBCASE("springs that tear all the time") {
    preset.F_max = 0.05;
  }
  same_as_single_steps(preset, steps_of(400), 3);
}

TEST_CASE("a cloth that no cache holds is stepped in waves on one thread too") {
  Preset preset = test::cloth(300, 310, "verlet");
  preset.precision = Precision::float_;
  same_as_single_steps(preset, steps_of(60), 1);
}

TEST_CASE("the hand's force and its release are those of single steps") {
  const Preset preset = threads_worth("verlet");
  const int pull = test::fewer(100, 20);  // steps
  for (const double F_release : {0.0, 0.02}) {
    CAPTURE(F_release);
    Simulation waves(preset, 3), single(preset);
    for (Simulation* simulation : {&waves, &single}) {
      Preset with = preset;
      with.F_release = F_release;
      simulation->apply(edit::Change{with});
      simulation->apply(edit::Grab{40, 30});
      simulation->apply(edit::MoveHand{{0, 0.5, 0.5}, pull});
    }
    int released_waves = 0, released_single = 0;
    for (int n = 0; n < 10; ++n) released_waves += int(waves.advance(3 * pull / 10).released);
    for (int n = 0; n < 3 * pull; ++n) released_single += int(single.advance(1).released);
    CHECK(released_waves == released_single);
    CHECK((released_single > 0) == (F_release > 0));
    if (F_release == 0) CHECK(waves.hand_force() == single.hand_force());
  }
}

TEST_CASE("divergence is found in the very step, and the steps since the last backup are made again" *
          doctest::test_suite("slow")) {
  // From not far above the limit of stability, where motion grows so little in a step that waves are begun, which it
  // then overtakes, to where every step is looked at.
  for (const char* integrator : {"verlet", "euler", "rk4"})
    for (const double above : {10.0, 30.0, 1e4}) {
      CAPTURE(std::string(integrator));
      CAPTURE(above);
      Preset preset = threads_worth(integrator);
      preset.k_d = 0;
      Simulation waves(preset, 3), single(preset);
      for (Simulation* simulation : {&waves, &single}) {
        simulation->advance(30);
        Preset stiff = preset;
        stiff.k_s = above * 4 * preset.m / (12 * preset.dt * preset.dt);
        simulation->apply(edit::Change{stiff});
      }
      while (!waves.divergence() && waves.steps() < 300) waves.advance(77);
      while (!single.divergence() && single.steps() < 300) single.advance(1);
      REQUIRE(waves.divergence().has_value());
      REQUIRE(single.divergence().has_value());
      CHECK(waves.divergence()->step == single.divergence()->step);
      CHECK(waves.divergence()->i == single.divergence()->i);
      CHECK(waves.divergence()->j == single.divergence()->j);
      CHECK(test::identical(waves.read(), single.read()));
    }
}

TEST_CASE("a cut between two calls is no part of the steps that were made before it") {
  Preset preset = threads_worth("euler");
  preset.k_d = 0, preset.dt = 1.5e-3;  // explodes by itself, before the next backup
  preset.initial_stretch = 1.02;
  Simulation waves(preset, 2), single(preset);
  for (Simulation* simulation : {&waves, &single}) {
    simulation->advance(10);
    simulation->apply(edit::Cut{{{20, 20}, {20, 21}, {20, 22}}});
  }
  while (!waves.divergence() && waves.steps() < 250) waves.advance(250);
  while (!single.divergence() && single.steps() < 250) single.advance(1);
  REQUIRE(waves.divergence().has_value());
  CHECK(waves.divergence()->step == single.divergence()->step);
  CHECK(test::identical(waves.read(), single.read()));
}

}  // namespace tyglab::waves_test
