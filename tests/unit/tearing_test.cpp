// Tearing and its guards (2.3.2), the hand and the knife (2.3.4).
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "tests/support/scenes.h"

namespace tyglab::tearing_test {

/// Flat, taut by 10 %, without gravity: every straight spring pulls k_s·L/10 = 0.15 N, every diagonal √2 times that.
Preset taut(int rows, int columns) {
  Preset preset = test::quiet_cloth(rows, columns, "verlet");
  preset.initial_stretch = 1.1;
  preset.dt = 1e-6;  // it hardly moves within a step
  return preset;
}

bool near(int i, int j, int i2, int j2) {
  return std::abs(i - i2) <= 1 && std::abs(j - j2) <= 1;
}

TEST_CASE("springs above F_max break, all together, those below stay") {
  Preset preset = taut(5, 6);
  preset.F_max = 0.18;  // between the straight ones and the diagonals
  Simulation simulation(preset);
  const AdvanceResult advance = simulation.advance(1);
  CHECK(advance.torn == 2 * 4 * 5);
  CHECK(simulation.tears().torn_count() == 2 * 4 * 5);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 5; ++j) {
      CHECK(simulation.tears().whole(0, i, j));
      CHECK(simulation.tears().whole(1, i, j));
      CHECK_FALSE(simulation.tears().whole(2, i, j));
      CHECK_FALSE(simulation.tears().triangle_whole(i, j, 0));
    }
  }
  // A torn cloth catches no wind, and its diagonals pull no more.
  Preset windy = preset;
  windy.W = {0, 0, 1};
  simulation.apply(edit::Change{windy});
  CHECK(simulation.particle(2, 2)["F_wind"] == glm::dvec3(0));
  CHECK(glm::length(simulation.particle(0, 0)["F_s"]) == doctest::Approx(0.15 * std::sqrt(2.0)).epsilon(1e-3));
}

TEST_CASE("0 means never") {
  Preset preset = taut(5, 6);
  preset.initial_stretch = 10;
  Simulation simulation(preset);
  CHECK(simulation.advance(3).torn == 0);
  CHECK(simulation.tears().untorn());
}

TEST_CASE("no spring breaks that touches a pinned particle or one of its eight neighbors") {
  Preset preset = taut(8, 9);
  preset.F_max = 0.01;
  preset.pins.mode = Pins::Mode::list;
  preset.pins.list = {{3, 4}};
  Simulation simulation(preset);
  simulation.advance(1);
  for (int direction = 0; direction < stretch_directions; ++direction) {
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < 9; ++j) {
        if (!simulation.lattice().has_spring(direction, i, j)) continue;
        const Direction& d = directions[direction];
        const bool guarded = near(i, j, 3, 4) || near(i + d.di, j + d.dj, 3, 4);
        CHECK(simulation.tears().whole(direction, i, j) == guarded);
      }
    }
  }
}

TEST_CASE("the held particle guards like a pinned one, until it is let go") {
  Preset preset = taut(8, 9);
  Simulation simulation(preset);
  simulation.apply(edit::Grab{4, 4});
  Preset tearing = preset;
  tearing.F_max = 0.01;
  simulation.apply(edit::Change{tearing});
  simulation.advance(1);
  CHECK(simulation.tears().whole(0, 4, 4));
  CHECK(simulation.tears().whole(0, 4, 5));
  CHECK_FALSE(simulation.tears().whole(0, 4, 6));
  CHECK_FALSE(simulation.tears().whole(1, 1, 1));
  simulation.apply(edit::Release{});
  simulation.advance(1);
  CHECK_FALSE(simulation.tears().whole(0, 4, 4));
}

TEST_CASE("a torn spring is torn for good, and restart mends") {
  Preset preset = taut(6, 6);
  preset.F_max = 0.01;
  Simulation simulation(preset);
  simulation.advance(1);
  const int torn = simulation.tears().torn_count();
  REQUIRE(torn > 0);
  Preset strong = preset;
  strong.F_max = 0;
  simulation.apply(edit::Change{strong});
  simulation.advance(10);
  CHECK(simulation.tears().torn_count() == torn);
  simulation.apply(edit::Restart{});
  CHECK(simulation.tears().untorn());
  CHECK(simulation.steps() == 0);
}

TEST_CASE("a bending spring dies with either stretch spring under it") {
  Preset preset = test::quiet_cloth(6, 6, "euler");
  preset.k_b = 5;
  preset.initial_stretch = 0.5;
  Simulation simulation(preset);
  const double push = glm::length(simulation.particle(0, 0)["F_b"]);
  CHECK(push == doctest::Approx(preset.k_b * preset.L * std::sqrt(2.0)));
  simulation.apply(edit::Cut{{{2, 0}}});  // (2,0) loses (1,0) and (1,1)
  const ParticleReadout corner = simulation.particle(0, 0);
  CHECK(corner["F_b"].y == 0);  // (0,0)-(2,0) is gone
  CHECK(std::abs(corner["F_b"].x) == doctest::Approx(preset.k_b * preset.L));
  CHECK(simulation.particle(1, 0)["F_b"].y == 0);  // (1,0)-(3,0) too
  CHECK(simulation.particle(2, 0)["F_b"].y == doctest::Approx(preset.k_b * preset.L));
}

TEST_CASE("a cut takes the three stretch springs upwards and the bending springs over them, guards or not") {
  Preset preset = test::cloth(6, 6);
  preset.pins.mode = Pins::Mode::boundary;
  Simulation simulation(preset);
  const std::uint64_t before = simulation.tear_revision();
  simulation.apply(edit::Cut{{{3, 2}}});
  CHECK(simulation.tear_revision() != before);
  const Tears& tears = simulation.tears();
  CHECK(tears.torn_count() == 3);
  CHECK_FALSE(tears.whole(2, 2, 1));
  CHECK_FALSE(tears.whole(1, 2, 2));
  CHECK_FALSE(tears.whole(3, 2, 3));
  CHECK_FALSE(tears.whole(5, 1, 2));
  CHECK_FALSE(tears.whole(5, 2, 2));
  CHECK(tears.whole(5, 3, 2));
  CHECK(tears.whole(0, 3, 1));
  CHECK(tears.whole(0, 3, 2));
  CHECK(tears.whole(1, 3, 2));
  // At the edges what is not there cannot be cut.
  simulation.apply(edit::Cut{{{0, 0}, {0, 5}, {1, 0}, {1, 5}}});
  CHECK(tears.torn_count() == 3 + 2 + 2);
  simulation.advance(5);
  CHECK_FALSE(simulation.divergence().has_value());
}

TEST_CASE("a row of cuts lets the lower part fall freely") {
  Preset preset = test::cloth(6, 4);
  preset.pins.mode = Pins::Mode::top_row;
  preset.tilt_deg = 90;
  Simulation simulation(preset);
  simulation.apply(edit::Cut{{{3, 0}, {3, 1}, {3, 2}, {3, 3}}});
  const double start = test::position(simulation.read(), 20).y;
  simulation.advance(100);
  CHECK(test::position(simulation.read(), 20).y == doctest::Approx(start - 9.82 * 0.01 / 2).epsilon(1e-9));
}

TEST_CASE("the held particle follows the hand evenly and then rests there") {
  for (const char* integrator :
       {"verlet", "euler", "improved_euler", "dopri5", "rkc2", "damped_verlet", "projective_dynamics", "vbd", "xpbd"}) {
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      Preset preset = test::cloth(8, 8, integrator);
      preset.precision = precision;
      Simulation simulation(preset);
      simulation.advance(10);
      simulation.apply(edit::Grab{5, 4});
      REQUIRE(simulation.held().has_value());
      CHECK((simulation.held()->i == 5 && simulation.held()->j == 4));
      const std::size_t p = 5 * 8 + 4;
      const glm::dvec3 from = test::position(simulation.read(), p), to = from + glm::dvec3(0.02, 0.01, 0.04);
      simulation.apply(edit::MoveHand{to, 40});
      simulation.advance(10);
      const double near_enough = precision == Precision::double_ ? 1e-12 : 1e-5;
      CHECK(glm::length(test::position(simulation.read(), p) - (from + 0.25 * (to - from))) < near_enough);
      CHECK(glm::length(test::velocity(simulation.read(), p) - (to - from) / (40 * preset.dt)) < 1e-3);
      simulation.advance(30);
      CHECK(glm::length(test::position(simulation.read(), p) - to) < near_enough);
      simulation.advance(50);
      CHECK(glm::length(test::position(simulation.read(), p) - to) < near_enough);
      CHECK(glm::length(test::velocity(simulation.read(), p)) < 1e-9);
      CHECK(simulation.particle(5, 4).held);
      simulation.apply(edit::Release{});
      CHECK_FALSE(simulation.held().has_value());
      simulation.advance(100);
      CHECK(glm::length(test::position(simulation.read(), p) - to) > 1e-4);
    }
  }
}

TEST_CASE("the force on the held particle is measured: at rest, its weight and what hangs from it") {
  // Two particles, the upper one held, the lower one hanging still from it.
  Preset preset = test::quiet_cloth(2, 1, "verlet");
  preset.g = 9.82;
  preset.initial_stretch = 1 + preset.m * preset.g / preset.k_s / preset.L;
  Simulation simulation(preset);
  simulation.apply(edit::Grab{0, 0});
  const AdvanceResult advance = simulation.advance(5);
  CHECK(glm::length(simulation.hand_force() - glm::dvec3(0, -2 * preset.m * preset.g, 0)) < 1e-12);
  CHECK(glm::length(advance.hand_force - simulation.hand_force()) < 1e-15);
}

TEST_CASE("the hand lets go when the force exceeds F_release, and never at 0") {
  for (const double F_release : {0.0, 0.5}) {
    Preset preset = test::cloth(8, 8);
    preset.F_release = F_release;
    Simulation simulation(preset);
    simulation.apply(edit::Grab{7, 4});
    simulation.apply(edit::MoveHand{{0, 0.3, 0.5}, 200});
    bool released = false;
    double largest_held = 0;
    for (int step = 0; step < 200; ++step) {
      const AdvanceResult advance = simulation.advance(1);
      released = released || advance.released;
      if (simulation.held()) largest_held = std::max(largest_held, glm::length(simulation.hand_force()));
    }
    CHECK(released == (F_release > 0));
    CHECK(simulation.held().has_value() == (F_release == 0));
    if (F_release > 0) CHECK(largest_held <= F_release);
    if (F_release == 0) CHECK(largest_held > 0.5);
  }
}

TEST_CASE("a pinned particle cannot be taken, nor one outside the cloth") {
  Simulation simulation(test::cloth(5, 5));
  for (const auto& [i, j] : {std::pair{0, 0}, {5, 0}, {-1, 2}, {2, 5}}) {
    try {
      simulation.apply(edit::Grab{i, j});
    } catch (const std::exception&) {
    }
    CHECK_FALSE(simulation.held().has_value());
  }
  simulation.advance(3);
  CHECK_FALSE(simulation.divergence().has_value());
}

TEST_CASE("pinning and unpinning while running") {
  Simulation simulation(test::cloth(5, 5));
  simulation.advance(20);
  simulation.apply(edit::Pin{4, 2, true});
  CHECK(simulation.pinned(4, 2));
  const glm::dvec3 x = test::position(simulation.read(), 22);
  simulation.advance(50);
  CHECK(test::position(simulation.read(), 22) == x);
  simulation.apply(edit::Pin{4, 2, false});
  simulation.apply(edit::Pin{0, 0, false});
  CHECK_FALSE(simulation.pinned(4, 2));
  CHECK_FALSE(simulation.pinned(0, 0));
  CHECK(simulation.pinned(0, 4));
  simulation.advance(50);
  CHECK(glm::length(test::position(simulation.read(), 22) - x) > 1e-4);
  CHECK_FALSE(simulation.divergence().has_value());
}

TEST_CASE("looking only when a spring may have grown enough finds what a look in every step finds") {
  // The engine skips looks by how far particles have moved. An edit makes it look again.
  Preset preset;
  preset.rows = preset.columns = 14;
  preset.pins.mode = Pins::Mode::top_row;
  preset.F_max = 0.02;
  preset.bodies = {Body{}};
  preset.bodies[0].c = {0, 0.75, 0.15}, preset.bodies[0].r = 0.1;
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    preset.precision = precision;
    Simulation rarely(preset), always(preset);
    for (Simulation* simulation : {&rarely, &always}) {
      simulation->apply(edit::Grab{12, 7});
      simulation->apply(edit::MoveHand{{0.2, 0.2, 0.4}, 400});
    }
    REQUIRE_FALSE(rarely.advance(400).diverged);
    for (int step = 0; step < 400; ++step) {
      always.apply(edit::Change{always.preset()});
      REQUIRE_FALSE(always.advance(1).diverged);
    }
    CHECK(rarely.tears().torn_count() > 10);
    CHECK(rarely.tears().torn_count() == always.tears().torn_count());
    for (int direction = 0; direction < stretch_directions; ++direction)
      for (int i = 0; i < preset.rows; ++i)
        for (int j = 0; j < preset.columns; ++j)
          CHECK(rarely.tears().whole(direction, i, j) == always.tears().whole(direction, i, j));
  }
}

}  // namespace tyglab::tearing_test
