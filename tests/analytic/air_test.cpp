// The air's drag and lift against closed forms, and that it gives no energy by itself.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/energy/ledger.h"
#include "core/forces/force.h"
#include "core/integrators/scheme.h"
#include "core/theory/advice.h"
#include "tests/support/scenes.h"

namespace tyglab::air_test {

constexpr double rho = 1.2;  // kg/m³

/// A free sheet of 9 x 9 that B keeps plane: its edges are lighter in the air than its middle.
Preset sheet(const std::string& integrator, double tilt_deg) {
  Preset preset = test::quiet_cloth(9, 9, integrator);
  preset.L = 0.02, preset.m = 8e-5, preset.tilt_deg = tilt_deg;
  preset.k_s = 1e3, preset.k_d = 0.01, preset.B = 0.05;
  preset.air_density = rho, preset.dt = 5e-5;
  return preset;
}
double mass_of(const Preset& p) {
  return p.m * p.rows * p.columns;
}
double area_of(const Preset& p) {
  return p.L * p.L * (p.rows - 1) * (p.columns - 1);
}

struct Mean {
  glm::dvec3 x{0}, v{0};
};
Mean mean_of(const State& state) {
  Mean mean;
  const std::size_t size = state.x.x.size();
  for (std::size_t p = 0; p < size; ++p)
    mean.x += test::position(state, p) / double(size), mean.v += test::velocity(state, p) / double(size);
  return mean;
}

TEST_CASE("a sheet that falls face on has the speed v_t tanh(g t/v_t), and its path is v_t²/g ln cosh(g t/v_t)") {
  for (const char* method : {"verlet", "rk4", "implicit_euler"}) {
    CAPTURE(std::string(method));
    Preset preset = sheet(method, 0);
    preset.g = 9.82, preset.C_N = 1.1;
    const double v_t = std::sqrt(2 * mass_of(preset) * preset.g / (rho * preset.C_N * area_of(preset)));
    Simulation simulation(preset);
    const double from = mean_of(simulation.read()).x.y;
    for (const double t : {0.1, 0.3}) {
      simulation.advance(int(std::lround(t / preset.dt)) - int(simulation.steps()));
      const Mean now = mean_of(simulation.read());
      const double v = v_t * std::tanh(preset.g * t / v_t);
      const double way = v_t * v_t / preset.g * std::log(std::cosh(preset.g * t / v_t));
      MESSAGE(std::string(method) << ", t = " << t << ": v " << -now.v.y / v - 1 << ", path "
                                  << (from - now.x.y) / way - 1);
      CHECK(std::abs(-now.v.y / v - 1) < 1e-3);
      CHECK(std::abs((from - now.x.y) / way - 1) < 1e-3);
      if (t > 0.2) CHECK(v > 0.8 * v_t);  // or the drag would hardly count
      CHECK(std::hypot(now.v.x, now.v.z) < 1e-3 * v);
    }
  }
}

TEST_CASE("a sheet that moves edge on is braked by C_T alone: v = v_0/(1 + v_0 ρ A C_T t/2M)") {
  for (const char* method : {"verlet", "rk4"}) {
    Preset preset = sheet(method, 90);
    // Over a short time: springs do not resist that the edges, which the air brakes less, come nearer.
    preset.C_N = 3, preset.C_T = 0.2, preset.v_0 = {2, 0, 0};
    Simulation simulation(preset);
    simulation.advance(2000);
    const double t = 2000 * preset.dt, rate = rho * area_of(preset) * preset.C_T / (2 * mass_of(preset));
    const Mean now = mean_of(simulation.read());
    MESSAGE(std::string(method) << ": " << now.v.x * (1 + 2 * rate * t) / 2 - 1);
    CHECK(std::abs(now.v.x * (1 + 2 * rate * t) / 2 - 1) < 1e-3);
    CHECK(now.v.x < 1.85);
    preset.C_T = 0;
    Simulation free(preset);
    free.advance(2000);
    CHECK(std::abs(mean_of(free.read()).v.x / 2 - 1) < 1e-6);
  }
}

TEST_CASE("a sheet at rest in a wind feels what one feels that moves through still air") {
  Preset still = sheet("rk4", 35), windy = still;
  still.C_T = windy.C_T = 0.3;
  still.v_0 = {1, -2, 3}, windy.u = {-1, 2, -3};
  Simulation moving(still), resting(windy);
  moving.advance(2000), resting.advance(2000);
  CHECK(glm::distance(mean_of(moving.read()).v - still.v_0, mean_of(resting.read()).v) < 1e-9);
  CHECK(glm::length(mean_of(resting.read()).v) > 0.5);
}

double kinetic(const State& state, double m) {
  double sum = 0;
  for (std::size_t p = 0; p < state.x.x.size(); ++p)
    sum += m / 2 * glm::dot(test::velocity(state, p), test::velocity(state, p));
  return sum;
}

TEST_CASE("the hand feels the air on its particle, with every method") {
  for (const Scheme& method : schemes()) {
    CAPTURE(std::string(method.name));
    Preset preset = sheet(std::string(method.name), 90);
    preset.B = 0, preset.k_d = 0, preset.u = {0, 0, 5}, preset.C_N = 1.1;
    Simulation simulation(preset);
    simulation.apply(edit::Grab{4, 4});
    simulation.advance(2);
    // A third of eight triangles of L²/2; springs hardly pull yet.
    const double F = 8.0 / 3 * rho * preset.C_N * preset.L * preset.L / 4 * 25;
    MESSAGE(std::string(method.name) << ": " << simulation.hand_force().z / F - 1);
    CHECK(std::abs(simulation.hand_force().z / F - 1) < 0.01);
    preset.air_density = 0;
    simulation.apply(edit::Change{preset});
    simulation.advance(1);
    CHECK(std::abs(simulation.hand_force().z) < 0.02 * F);
  }
}

TEST_CASE("still air takes kinetic energy in every step of every method, however long dt is") {
  for (const Scheme& method : schemes())
    for (const double dt : {1e-3, 0.3})
      for (const std::uint64_t seed : {1, 2}) {
        Preset preset = test::quiet_cloth(8, 7, std::string(method.name));
        preset.k_s = 0, preset.air_density = 50, preset.C_N = 1.4, preset.C_T = 0.6, preset.dt = dt;
        CAPTURE(std::string(method.name));
        CAPTURE(dt);
        Simulation simulation(preset);
        test::load(simulation, test::crumpled(preset, seed, 0.6, 5));
        double before = kinetic(simulation.read(), preset.m);
        const double first = before;
        for (int n = 0; n < 12; ++n) {
          simulation.advance(1);
          const double now = kinetic(simulation.read(), preset.m);
          CHECK(now <= before * (1 + 1e-12));
          before = now;
        }
        CHECK(before < 0.9 * first);
      }
}

TEST_CASE("no method gains energy in a crumpled cloth by still air, and the ledger's work of the air is below 0") {
  for (const Scheme& method : schemes()) {
    Preset preset = test::quiet_cloth(9, 8, std::string(method.name));
    preset.g = 9.82, preset.k_d = 0.002, preset.air_density = rho, preset.C_T = 0.2;
    preset.dt = std::min(1e-3, advised_dt(preset, preset.integrator));
    if (!(preset.dt > 0)) preset.dt = 1e-5;
    CAPTURE(std::string(method.name));
    Simulation simulation(preset);
    test::load(simulation, test::crumpled(preset, 5, 0.4, 2));
    simulation.enable_ledger(true);
    const auto total = [&] { return simulation.ledger()->energy.total(); };
    const double first = total();
    double most = first;
    for (int n = 0; n < 40; ++n) simulation.advance(5), most = std::max(most, total());
    CHECK(most <= first + 1e-2 * std::abs(first));
    CHECK(simulation.ledger()->works.of[force::air] < 0);
  }
}

TEST_CASE("a flag flutters in a wind and comes to rest in still air") {
  for (const char* method : {"verlet", "implicit_euler"}) {
    CAPTURE(std::string(method));
    Preset preset = test::quiet_cloth(12, 16, method);
    preset.pins.mode = Pins::Mode::left_column, preset.tilt_deg = 90, preset.g = 9.82;
    preset.m = 1e-4, preset.k_d = 1e-3, preset.k_b = 0.5;
    preset.air_density = rho, preset.C_T = 0.02, preset.u = {5, 0, 0.8};
    preset.dt = preset.integrator == "verlet" ? 5e-4 : 2e-3;
    Simulation simulation(preset);
    const auto seconds = [&](double t) { simulation.advance(int(std::lround(t / preset.dt))); };
    seconds(2);
    double least = 1e9, most = 0, moves = 0;
    const int free_end = 15;
    for (int n = 0; n < 100; ++n) {
      seconds(0.02);
      const double z = simulation.position(6, free_end).z;
      least = std::min(least, z), most = std::max(most, z);
      moves += kinetic(simulation.read(), preset.m) / 100;
    }
    CHECK(simulation.position(6, free_end).x > simulation.position(6, 0).x + 0.5 * 15 * preset.L);  // it streams
    CHECK(most - least > preset.L);
    Preset calm = preset;
    calm.u = glm::dvec3(0);
    simulation.apply(edit::Change{calm});
    seconds(20);
    const double rest = kinetic(simulation.read(), preset.m);
    MESSAGE(std::string(method) << ": swings by " << (most - least) / preset.L << " L; moves with " << moves
                                << " J, then " << rest);
    CHECK(rest < 1e-3 * moves);
  }
}

}  // namespace tyglab::air_test
