// Every parameter can change between two steps.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "core/cloth/state.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/preset.h"
#include "tests/support/scenes.h"

namespace tyglab::change_test {

Preset changed(const Preset& preset, const std::string& setting) {
  return with_settings(preset, {setting});
}

double furthest(const State& a, const State& b) {
  REQUIRE(a.x.x.size() == b.x.x.size());
  double largest = 0;
  for (std::size_t p = 0; p < a.x.x.size(); ++p) {
    largest = std::max(largest, glm::length(test::position(a, p) - test::position(b, p)));
  }
  return largest;
}

double furthest_velocity(const State& a, const State& b) {
  double largest = 0;
  for (std::size_t p = 0; p < a.x.x.size(); ++p) {
    largest = std::max(largest, glm::length(test::velocity(a, p) - test::velocity(b, p)));
  }
  return largest;
}

TEST_CASE("a change of a constant keeps the state and counts from the next step") {
  for (const char* setting : {"k_s=30", "k_b=0", "k_d=0.004", "m=0.0005", "g=1.62", "W=[0,0,0.001]", "L=0.031"}) {
    CAPTURE(std::string(setting));
    const Preset preset = test::cloth(8, 7);
    Simulation simulation(preset), other(preset);
    simulation.advance(100);
    other.advance(100);
    const State before = simulation.read();
    simulation.apply(edit::Change{changed(preset, setting)});
    CHECK(furthest(simulation.read(), before) == 0);
    CHECK(furthest_velocity(simulation.read(), before) < 1e-14);
    CHECK(simulation.steps() == 100);
    CHECK(simulation.time() == doctest::Approx(0.1));
    simulation.advance(50);
    other.advance(50);
    CHECK_FALSE(simulation.divergence().has_value());
    CHECK(furthest(simulation.read(), other.read()) > 1e-7);
  }
}

TEST_CASE("a cloth can be read while another thread makes of it what a change asks for") {
  Preset preset = test::cloth(40, 40, "velocity_verlet");  // whose velocity takes an evaluation of the force
  Simulation simulation(preset, 2), alone(preset, 2);
  for (int n = 0; n < 20; ++n) {
    simulation.advance(5), alone.advance(5);
    std::unique_ptr<Simulation> made;
    std::thread worker([&] { made = simulation.rebuilt(edit::Change{changed(preset, "precision=double")}); });
    const State seen = simulation.read();
    worker.join();
    CHECK(test::identical(seen, alone.read()));
    CHECK(furthest_velocity(made->read(), seen) < 1e-5);
  }
}

TEST_CASE("a change of method, dt or precision keeps positions and velocities") {
  // With damping, a(x, v) sees the velocity of the step before, and v[n] + dt/2 a is exact but for dt²/4 k_d/m a.
  for (const auto& [from, k_d] : {std::pair{"verlet", 0.0},
                                  {"euler", 0.0},
                                  {"improved_euler", 0.0},
                                  {"verlet", 2e-3},
                                  {"euler", 2e-3},
                                  {"improved_euler", 2e-3}}) {
    for (const char* setting : {"integrator=verlet", "integrator=euler", "integrator=improved_euler", "dt=0.00005",
                                "dt=0.0003", "precision=float", "precision=double"}) {
      CAPTURE(std::string(from));
      CAPTURE(k_d);
      CAPTURE(std::string(setting));
      Preset preset = test::cloth(8, 7, from);
      preset.dt = 1e-4;
      preset.k_d = k_d;
      Simulation simulation(preset);
      simulation.advance(300);
      const State before = simulation.read();
      simulation.apply(edit::Change{changed(preset, setting)});
      const bool to_float = std::string(setting) == "precision=float";
      CHECK(furthest(simulation.read(), before) <= (to_float ? 2e-7 : 0.0));
      CHECK(furthest_velocity(simulation.read(), before) < (to_float || k_d > 0 ? 1e-5 : 1e-11));
      CHECK(simulation.steps() == 300);
      simulation.advance(100);
      CHECK_FALSE(simulation.divergence().has_value());
    }
  }
}

TEST_CASE("time goes on from where it was when dt changes") {
  Preset preset = test::cloth(4, 4);
  Simulation simulation(preset);
  simulation.advance(100);
  preset.dt = 5e-4;
  simulation.apply(edit::Change{preset});
  CHECK(simulation.time() == doctest::Approx(0.1).epsilon(1e-15));
  simulation.advance(100);
  CHECK(simulation.time() == doctest::Approx(0.15).epsilon(1e-15));
  CHECK(simulation.steps() == 200);
}

TEST_CASE("rows and columns rebuild the cloth and keep the rest") {
  Preset preset = test::cloth(8, 7);
  preset.F_max = 3;
  Simulation simulation(preset);
  simulation.advance(50);
  simulation.apply(edit::Cut{{{4, 4}}});
  Preset bigger = preset;
  bigger.rows = 12;
  bigger.columns = 5;
  simulation.apply(edit::Change{bigger});
  CHECK(simulation.lattice() == Lattice{12, 5});
  CHECK(simulation.tears().untorn());
  CHECK(simulation.preset() == bigger);
  CHECK(simulation.positions().rows == 12);
  CHECK(simulation.positions().columns == 5);
  Simulation fresh(bigger);
  CHECK(furthest(simulation.read(), fresh.read()) == 0);
  simulation.advance(50);
  fresh.advance(50);
  CHECK(furthest(simulation.read(), fresh.read()) == 0);
}

TEST_CASE("from a cloth to one weight and back") {
  Simulation simulation(test::cloth(8, 7));
  simulation.advance(10);
  simulation.apply(edit::Change{test::one_weight()});
  simulation.advance(10);
  CHECK(simulation.preset().kind == Kind::one_weight);
  CHECK_FALSE(simulation.divergence().has_value());
  simulation.apply(edit::Change{test::cloth(3, 1)});
  simulation.advance(10);
  CHECK(simulation.lattice().size() == 3);
  CHECK_FALSE(simulation.divergence().has_value());
}

TEST_CASE("what counts at the start waits for the restart") {
  for (const char* setting : {"x_0=[1,2,3]", "v_0=[1,0,0]", "tilt_deg=10", "initial_stretch=1.05"}) {
    CAPTURE(std::string(setting));
    const Preset preset = test::cloth(6, 5);
    const Preset other = changed(preset, setting);
    Simulation simulation(preset);
    simulation.advance(20);
    const State before = simulation.read();
    simulation.apply(edit::Change{other});
    CHECK(furthest(simulation.read(), before) == 0);
    simulation.apply(edit::Restart{});
    CHECK(furthest(simulation.read(), start_state(other)) == 0);
    // Before the first step it counts at once.
    Simulation waiting(preset);
    waiting.apply(edit::Change{other});
    CHECK(furthest(waiting.read(), start_state(other)) == 0);
  }
}

TEST_CASE("before the first step the read-out shows the velocity that the scene begins with") {
  Preset weight = test::one_weight(), cloth = test::cloth(6, 5);
  weight.k_d = 0.5;  // the damping in Verlet's own start is not that of half a step ago
  cloth.k_d = 0.05, cloth.v_0 = {0.3, -0.2, 0.1}, cloth.pins.mode = Pins::Mode::top_row;
  for (const Preset& preset : {weight, cloth})
    for (const Scheme& scheme : schemes()) {
      Preset of = preset;
      of.integrator = scheme.name;
      CAPTURE(of.integrator);
      Simulation simulation(of);
      const Snapshot start = simulation.snapshot();
      const int last = simulation.lattice().rows - 1;
      const auto as_begun = [&] {
        CHECK(simulation.particle(last, 0).v == starting_velocity(of));
        CHECK(simulation.particle(last, 0)["F_d"] == glm::dvec3(0));
        CHECK(test::velocity(simulation.read(), last * simulation.lattice().columns) == starting_velocity(of));
      };
      as_begun();
      simulation.advance(1);
      CHECK(simulation.particle(last, 0).v != starting_velocity(of));
      simulation.restore(start);
      as_begun();
    }
}

TEST_CASE("before the first step a change is a fresh start that keeps cuts and the hand") {
  Preset preset = test::cloth(6, 5);
  preset.v_0 = {0.3, 0, 0};
  Simulation simulation(preset);
  simulation.apply(edit::Cut{{{3, 2}}});
  simulation.apply(edit::Grab{5, 2});
  preset.k_s = 40;
  preset.dt = 5e-4;
  preset.pins.mode = Pins::Mode::left_column;
  simulation.apply(edit::Change{preset});
  CHECK(simulation.tears().torn_count() == 3);
  CHECK(simulation.held().has_value());
  simulation.apply(edit::Release{});
  simulation.apply(edit::Change{preset});
  Simulation fresh(preset);
  fresh.apply(edit::Cut{{{3, 2}}});
  simulation.advance(50);
  fresh.advance(50);
  CHECK(furthest(simulation.read(), fresh.read()) < 1e-12);
}

TEST_CASE("a change of pins fixes and frees particles where they are") {
  Preset preset = test::cloth(6, 5);
  Simulation simulation(preset);
  simulation.advance(60);
  const State before = simulation.read();
  preset.pins.mode = Pins::Mode::left_column;
  simulation.apply(edit::Change{preset});
  CHECK(furthest(simulation.read(), before) == 0);
  CHECK(simulation.pinned(5, 0));
  CHECK_FALSE(simulation.pinned(0, 4));
  simulation.advance(50);
  CHECK(test::position(simulation.read(), 25) == test::position(before, 25));
  CHECK(glm::length(test::position(simulation.read(), 4) - test::position(before, 4)) > 1e-5);
}

TEST_CASE("an impossible change throws and leaves everything as it was") {
  const Preset preset = test::cloth(6, 5);
  Simulation simulation(preset);
  simulation.advance(20);
  const State before = simulation.read();
  Preset wrong = preset;
  wrong.m = -1;
  CHECK_THROWS_AS(simulation.apply(edit::Change{wrong}), PresetError);
  wrong = preset;
  wrong.integrator = "magic";
  CHECK_THROWS_AS(simulation.apply(edit::Change{wrong}), PresetError);
  wrong = preset;
  wrong.x_0.x = std::nan("");
  CHECK_THROWS_AS(simulation.apply(edit::Change{wrong}), PresetError);
  CHECK(simulation.preset() == preset);
  CHECK(test::identical(simulation.read(), before));
  simulation.advance(5);
  CHECK(simulation.steps() == 25);
}

TEST_CASE("the revision counts up with everything that moves, and only then") {
  Simulation simulation(test::cloth(6, 5));
  std::uint64_t last = simulation.revision();
  simulation.read();
  simulation.forces(Reduction::sum);
  CHECK(simulation.revision() == last);
  const auto moved = [&] {
    const bool more = simulation.revision() > last;
    last = simulation.revision();
    return more;
  };
  simulation.advance(1);
  CHECK(moved());
  simulation.apply(edit::Restart{});
  CHECK(moved());
  simulation.advance(0);
  CHECK_FALSE(moved());
}

TEST_CASE("resolution keeps size, mass and stretch behavior") {
  Preset preset = test::cloth(9, 13);
  preset.F_max = 2;
  preset.W = {0, 0.01, 0.02};
  preset.F_release = 1.5;
  const Preset fine = with_resolution(preset, 2);
  CHECK(fine.rows == 17);
  CHECK(fine.columns == 25);
  CHECK(fine.L == doctest::Approx(preset.L / 2));
  CHECK(fine.F_max == doctest::Approx(1));
  CHECK(glm::length(fine.W - preset.W / 4.0) < 1e-16);
  CHECK(fine.dt == doctest::Approx(preset.dt / 2));
  CHECK(fine.m * 17 * 25 == doctest::Approx(preset.m * 9 * 13));
  CHECK(fine.k_s == preset.k_s);
  CHECK(fine.k_d == preset.k_d);
  CHECK(fine.k_b == preset.k_b);
  CHECK(fine.g == preset.g);
  CHECK(fine.F_release == preset.F_release);
  CHECK(check_preset(fine) == "");
  const Preset coarse = with_resolution(preset, 0.5);
  CHECK(coarse.rows == 5);
  CHECK(coarse.columns == 7);
  CHECK(coarse.L == doctest::Approx(preset.L * 2));
  CHECK(coarse.F_max == doctest::Approx(4));
  CHECK(with_resolution(preset, 1) == preset);
}

TEST_CASE("resolution moves pin lists to the nearest particle and stays in range") {
  Preset preset = test::cloth(9, 13);
  preset.pins.mode = Pins::Mode::list;
  preset.pins.list = {{0, 0}, {4, 6}, {8, 12}};
  const Preset fine = with_resolution(preset, 2);
  CHECK(fine.pins.list == std::vector<Pins::Site>{{0, 0}, {8, 12}, {16, 24}});
  for (const double q : {1e-6, 0.01, 0.5, 1.5, 3.0, 100.0}) {
    CAPTURE(q);
    // Either a preset within every range, or a refusal with a reason.
    try {
      CHECK(check_preset(with_resolution(preset, q)) == "");
    } catch (const PresetError& error) {
      CHECK(std::string(error.what()).size() > 10);
    }
  }
  const Preset line = with_resolution(test::cloth(5, 1), 2);
  CHECK(line.rows == 9);
  CHECK(line.columns == 1);
}

}  // namespace tyglab::change_test
