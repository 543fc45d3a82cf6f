// Motions whose exact result is known on paper.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/io/preset_io.h"
#include "tests/oracle/oracle.h"
#include "tests/support/scenes.h"

namespace tyglab::closed_form_test {

/// Two particles one above the other, neither pinned: they fall together, and no spring ever pulls.
Preset falling(const std::string& integrator, double dt) {
  Preset preset = test::quiet_cloth(2, 1, integrator);
  preset.g = 9.82;
  preset.dt = dt;
  preset.v_0 = {0.5, 2, -1};
  return preset;
}

glm::dvec3 top(Simulation& simulation) {
  return test::position(simulation.read(), 0);
}
glm::dvec3 top_velocity(Simulation& simulation) {
  return test::velocity(simulation.read(), 0);
}

TEST_CASE("free fall in double follows each method's own closed form") {
  const int n = 1000;
  for (const char* integrator : {"verlet", "improved_euler", "euler"}) {
    CAPTURE(std::string(integrator));
    const Preset preset = falling(integrator, 1e-3);
    Simulation simulation(preset);
    simulation.advance(n);
    const double t = n * preset.dt;
    // Verlet and improved Euler fall exactly; Euler's last half step of each velocity is missing.
    const double fallen =
        std::string(integrator) == "euler" ? preset.g * preset.dt * preset.dt * n * (n - 1) / 2 : preset.g * t * t / 2;
    const glm::dvec3 wanted = preset.x_0 + preset.v_0 * t - glm::dvec3(0, fallen, 0);
    CHECK(glm::length(top(simulation) - wanted) < 1e-11);
    CHECK(glm::length(top_velocity(simulation) - (preset.v_0 - glm::dvec3(0, preset.g * t, 0))) < 1e-11);
    CHECK(simulation.time() == doctest::Approx(t).epsilon(1e-14));
  }
}

TEST_CASE("free fall of Verlet in float at dt = 1e-4 is right within 0.01 %") {
  Preset preset = falling("verlet", 1e-4);
  preset.v_0 = {0, 0, 0};
  preset.precision = Precision::float_;
  Simulation simulation(preset);
  simulation.advance(10000);
  const double fallen = preset.x_0.y - top(simulation).y;
  CHECK(fallen == doctest::Approx(preset.g / 2).epsilon(1e-4));
}

TEST_CASE("Verlet's start: state files hold d/dt, read-outs the velocity at x[n]") {
  const Preset preset = falling("verlet", 1e-2);
  Simulation simulation(preset);
  const glm::dvec3 raw = test::velocity(simulation.read_raw(), 0);
  CHECK(glm::length(raw - (preset.v_0 + glm::dvec3(0, preset.g * preset.dt / 2, 0))) < 1e-13);
  CHECK(glm::length(top_velocity(simulation) - preset.v_0) < 1e-13);
  simulation.advance(1);
  const glm::dvec3 step = top(simulation) - preset.x_0;
  CHECK(glm::length(step - (preset.dt * preset.v_0 - glm::dvec3(0, preset.g * preset.dt * preset.dt / 2, 0))) < 1e-14);
}

TEST_CASE("a change of dt leaves a free fall on its parabola, velocity and all") {
  for (const char* integrator : {"verlet", "improved_euler"}) {
    CAPTURE(std::string(integrator));
    Preset preset = falling(integrator, 1e-3);
    Simulation simulation(preset);
    double t = 0;
    for (const double dt : {1e-3, 1e-2, 1e-4, 3e-3, 1e-3}) {
      preset.dt = dt;
      simulation.apply(edit::Change{preset});
      CHECK(glm::length(top_velocity(simulation) - (preset.v_0 - glm::dvec3(0, preset.g * t, 0))) < 1e-11);
      simulation.advance(37);
      t += 37 * dt;
      const glm::dvec3 wanted = preset.x_0 + preset.v_0 * t - glm::dvec3(0, preset.g * t * t / 2, 0);
      CHECK(glm::length(top(simulation) - wanted) < 1e-11);
      CHECK(simulation.time() == doctest::Approx(t).epsilon(1e-13));
    }
  }
}

TEST_CASE("one weight follows the oracle's recurrence") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    for (const double k_d : {0.0, 0.05}) {
      CAPTURE(std::string(integrator));
      CAPTURE(k_d);
      Preset preset = test::one_weight(integrator);
      preset.k_d = k_d;
      preset.v_0 = {0, 0.7, 0};
      REQUIRE(check_preset(preset) == "");
      Simulation simulation(preset);
      oracle::Weight weight(preset);
      for (int n = 0; n < 1000; ++n) {
        CHECK(simulation.positions().at(0, 0).y == doctest::Approx(weight.y).epsilon(1e-12));
        CHECK(simulation.read_raw().v.y[0] == doctest::Approx(weight.v).epsilon(1e-9));
        simulation.advance(1);
        weight.step();
      }
    }
  }
}

TEST_CASE("one weight under Verlet is the exact solution of y[n+1] - 2 y[n] + y[n-1] = -(h w)^2 (y[n] - y_eq)") {
  const Preset preset = test::one_weight();
  Simulation simulation(preset);
  const double w2 = preset.k / preset.m, y_eq = preset.x_0.y - preset.m * preset.g / preset.k;
  // y[n] = y_eq + A cos(n phi) with cos(phi) = 1 - (h w)²/2: started from rest, the sine part is zero.
  const double phi = std::acos(1 - preset.dt * preset.dt * w2 / 2), A = preset.x_0.y + preset.offset - y_eq;
  for (int n = 0; n <= 20000; n += 100) {
    CHECK(simulation.positions().at(0, 0).y == doctest::Approx(y_eq + A * std::cos(n * phi)).epsilon(1e-9));
    simulation.advance(100);
  }
}

TEST_CASE("the energy of one undamped weight stays bounded under Verlet") {
  Preset preset = test::one_weight();
  Simulation simulation(preset);
  const auto energy = [&] {
    const State& s = simulation.read();
    const double y = s.x.y[0], v = s.v.y[0], stretch = y - preset.x_0.y;
    return preset.m * v * v / 2 + preset.k * stretch * stretch / 2 + preset.m * preset.g * stretch;
  };
  const double start = energy();
  double largest = 0;
  for (int n = 0; n < 1000; ++n) {
    simulation.advance(100);
    largest = std::max(largest, std::abs(energy() - start));
  }
  const double h2w2 = preset.dt * preset.dt * preset.k / preset.m;
  CHECK(largest < h2w2 * 0.5);
}

TEST_CASE("wind on a flat cloth: each whole triangle catches N (N·W), a third at each corner") {
  Preset preset = test::quiet_cloth(4, 5, "euler");
  preset.W = {0.3, 0.2, 0.6};
  Simulation simulation(preset);
  glm::dvec3 sum(0);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 5; ++j) sum += simulation.particle(i, j)["F_wind"];
  }
  // It hangs in the plane z = 0, so N = ±z and of W only the z component counts: 2·3·4 triangles.
  CHECK(glm::length(sum - glm::dvec3(0, 0, 24 * 0.6)) < 1e-12);
  // In the diamond pattern an inner particle is in eight triangles where i + j is even, in four where it is odd.
  CHECK(simulation.particle(1, 1)["F_wind"].z == doctest::Approx(8 * 0.6 / 3));
  CHECK(simulation.particle(1, 2)["F_wind"].z == doctest::Approx(4 * 0.6 / 3));
  CHECK(simulation.particle(0, 0)["F_wind"].z == doctest::Approx(2 * 0.6 / 3));
  CHECK(simulation.particle(0, 4)["F_wind"].z == doctest::Approx(2 * 0.6 / 3));
}

}  // namespace tyglab::closed_form_test
