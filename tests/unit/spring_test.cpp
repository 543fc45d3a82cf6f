// Single springs through the program's own read-out: when they pull, push, damp, and when they have no direction.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "tests/support/scenes.h"

namespace tyglab::spring_test {

/// Particles in a column, L = 1, at these heights and horizontal velocities; the first is row 0.
std::unique_ptr<Simulation> column(std::vector<double> heights, std::vector<double> speeds, Preset preset) {
  preset.rows = int(heights.size());
  preset.columns = 1;
  preset.L = 1;
  auto simulation = std::make_unique<Simulation>(preset);
  State state = start_state(preset);
  for (std::size_t p = 0; p < heights.size(); ++p) {
    state.x.x[p] = 0;
    state.x.y[p] = heights[p];
    state.x.z[p] = 0;
    state.v.x[p] = speeds[p];
  }
  test::load(*simulation, state);
  return simulation;
}

Preset springs(Precision precision) {
  Preset preset = test::quiet_cloth(2, 1, "euler");
  preset.k_s = 3;
  preset.k_b = 5;
  preset.k_d = 0.25;
  preset.precision = precision;
  return preset;
}

TEST_CASE("a stretch spring pulls only, by k_s times what it is longer than L") {
  for (const Precision precision : {Precision::double_, Precision::float_}) {
    const double epsilon = precision == Precision::double_ ? 1e-14 : 1e-6;
    auto taut = column({0, -1.5}, {0, 0}, springs(precision));
    CHECK(taut->particle(0, 0)["F_s"].y == doctest::Approx(-1.5).epsilon(epsilon));
    CHECK(taut->particle(1, 0)["F_s"].y == doctest::Approx(1.5).epsilon(epsilon));
    auto rest = column({0, -1}, {0, 0}, springs(precision));
    CHECK(rest->particle(0, 0)["F_s"] == glm::dvec3(0));
    auto slack = column({0, -0.5}, {0, 0}, springs(precision));
    CHECK(slack->particle(0, 0)["F_s"] == glm::dvec3(0));
    CHECK(slack->particle(0, 0)["F_b"] == glm::dvec3(0));
  }
}

TEST_CASE("a bending spring pushes only, by k_b times what it is shorter than 2 L") {
  auto folded = column({0, -0.8, -1.6}, {0, 0, 0}, springs(Precision::double_));
  CHECK(folded->particle(0, 0)["F_b"].y == doctest::Approx(2.0));
  CHECK(folded->particle(1, 0)["F_b"] == glm::dvec3(0));
  CHECK(folded->particle(2, 0)["F_b"].y == doctest::Approx(-2.0));
  CHECK(folded->particle(0, 0)["F_s"] == glm::dvec3(0));
  auto stretched = column({0, -1.2, -2.4}, {0, 0, 0}, springs(Precision::double_));
  CHECK(stretched->particle(0, 0)["F_b"] == glm::dvec3(0));
}

TEST_CASE("damping takes the whole relative velocity, taut or slack, and bending springs have none") {
  for (const double spacing : {0.6, 1.4}) {
    auto moving = column({0, -spacing, -2 * spacing}, {1, 0, 5}, springs(Precision::double_));
    CHECK(moving->particle(0, 0)["F_d"].x == doctest::Approx(-0.25 * (1 - 0)));
    CHECK(moving->particle(1, 0)["F_d"].x == doctest::Approx(-0.25 * (0 - 1) - 0.25 * (0 - 5)));
    CHECK(moving->particle(2, 0)["F_d"].x == doctest::Approx(-0.25 * (5 - 0)));
  }
}

TEST_CASE("a diagonal spring rests at the square root of two times L") {
  Preset preset = springs(Precision::double_);
  preset.rows = preset.columns = 2;
  preset.L = 1;
  preset.k_b = 0;
  Simulation simulation(preset);
  State state = start_state(preset);
  // The bottom right particle moves out along the diagonal from the top left one.
  state.x.x[3] += 0.5;
  state.x.y[3] -= 0.5;
  test::load(simulation, state);
  const double diagonal = preset.k_s * (std::hypot(1.5, 1.5) - std::sqrt(2.0));
  CHECK(glm::length(simulation.particle(0, 0)["F_s"]) == doctest::Approx(diagonal));
}

TEST_CASE("particles on one spot have no force between them, never NaN") {
  for (const char* integrator :
       {"verlet", "euler", "improved_euler", "dopri5", "rkc2", "damped_verlet", "projective_dynamics", "vbd", "xpbd"}) {
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      Preset preset = springs(precision);
      preset.integrator = integrator;
      preset.rows = 4;
      preset.columns = 5;
      preset.W = {0, 0, 1};
      Simulation simulation(preset);
      State state = start_state(preset);
      for (auto* x : {&state.x.x, &state.x.y, &state.x.z}) std::fill(x->begin(), x->end(), 0.25);
      test::load(simulation, state);
      for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 5; ++j) CHECK(simulation.particle(i, j)["F"] == glm::dvec3(0));
      }
      simulation.advance(20);
      CHECK_FALSE(simulation.divergence().has_value());
      CHECK(test::all_finite(simulation.read()));
      // With no direction anywhere nothing moves.
      CHECK(test::position(simulation.read(), 7) == glm::dvec3(0.25));
    }
  }
}

TEST_CASE("a spring shorter than 1e-9 of its rest length has no direction") {
  const double tiny = 1e-10;
  auto folded = column({0, -0.5, -tiny}, {0, 0, 0}, springs(Precision::double_));
  CHECK(folded->particle(0, 0)["F_b"] == glm::dvec3(0));
  auto just = column({0, -0.5, -1e-8}, {0, 0, 0}, springs(Precision::double_));
  CHECK(just->particle(0, 0)["F_b"].y == doctest::Approx(10.0));
}

TEST_CASE("a triangle of zero area catches no wind") {
  Preset preset = springs(Precision::double_);
  preset.rows = 3;
  preset.columns = 2;
  preset.W = {1, 1, 1};
  Simulation simulation(preset);
  State state = start_state(preset);
  std::fill(state.x.x.begin(), state.x.x.end(), 0.0);  // both columns on one line
  test::load(simulation, state);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 2; ++j) CHECK(simulation.particle(i, j)["F_wind"] == glm::dvec3(0));
  }
}

}  // namespace tyglab::spring_test
