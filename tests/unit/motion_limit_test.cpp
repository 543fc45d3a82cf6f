// Motions that follow the model stay within what has given them energy, without the factor that a verdict takes: torn
// or whole, free, pinned or held, in wind without end, on bodies and out of them.
#include "core/engines/motion_limit.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "core/forces/contact.h"
#include "core/integrators/scheme.h"
#include "core/theory/advice.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::motion_limit_test {

/// A small cloth whose springs tear at once or soon, so that none of them may hold much.
Preset tearing(int rows, int columns, const std::string& integrator) {
  Preset p = test::cloth(rows, columns, integrator);
  p.pins.mode = Pins::Mode::none, p.F_max = 1e-3;
  p.dt = std::min(2e-4, 0.2 * stable_dt(p, integrator));
  return p;
}

std::vector<std::string> methods_in_question() {
  std::vector<std::string> names;
  for (const Scheme& method : schemes())
    if (method.name != "euler" && method.name != "improved_euler") names.emplace_back(method.name);
  return names;
}

/// Steps while nothing but time passes, and checks the bound itself now and then.
void check_bound(Simulation& simulation, int steps) {
  const Preset& p = simulation.preset();
  MotionLimit limit;
  limit.set_scene(p, simulation.lattice(), false, {});
  double pushes = 0;  // out of bodies that the cloth begins in
  for (const Body& body : p.bodies)
    for (int n = 0; n < simulation.lattice().size(); ++n)
      pushes += std::pow(std::max(depth(placed(body), test::position(simulation.read(), n)), 0.0), 2);
  limit.begin(
      {2 / p.m * (simulation.energy().energy.kinetic + simulation.energy().energy.elastic()), 0, std::sqrt(pushes)});
  for (int n = 0; n < steps; ++n) {
    simulation.advance(1);
    limit.pass(p.dt);
    if (n % 16 != 0) continue;
    const double squared = 2 / p.m * simulation.energy().energy.kinetic;
    CHECK(squared <= 1.02 * limit.given_squared());
    CHECK(simulation.excess() <= 1.02);
  }
  CHECK_FALSE(simulation.divergence().has_value());
}

TEST_CASE("stretched, thrown, falling and blown cloths are within the bound by every method" *
          doctest::test_suite("slow")) {
  const std::function<void(Preset&)> scenes[] = {
      [](Preset& p) { p.initial_stretch = 1.4, p.g = 0; },
      [](Preset& p) { p.initial_stretch = 1.4, p.F_max = 0.3, p.g = 0, p.k_d = 0; },
      [](Preset& p) {
        p.g = 100, p.v_0 = {3, 1, -2};
      },
      [](Preset& p) {
        p.g = 0, p.W = {0.002, 0.001, 0.03}, p.F_max = 0.01;
      },
      [](Preset& p) {
        p.g = 0, p.W = {0, 0, 0.03}, p.F_max = 0.02, p.pins.mode = Pins::Mode::left_column;
      },
      [](Preset& p) { p.F_max = 0.05, p.pins.mode = Pins::Mode::top_corners, p.tilt_deg = 0; },
      [](Preset& p) { p.rows = 30, p.columns = 1, p.F_max = 5, p.pins.mode = Pins::Mode::top_row, p.tilt_deg = 0; },
      [](Preset& p) {
        p.g = 0, p.B = 2e-4, p.kappa_warp = 25, p.kappa_weft = -18, p.F_max = 0.05,
        p.dt = std::min(p.dt, 0.2 * stable_dt(p, p.integrator));
      },
      [](Preset& p) { p.bodies = {Body{.shape = Body::Shape::plane, .y = 0.9, .restitution = 1}}; },
  };
  for (const std::string& name : methods_in_question())
    for (std::size_t n = 0; n < std::size(scenes); ++n) {
      CAPTURE(name);
      CAPTURE(n);
      Preset preset = tearing(7, 6, name);
      scenes[n](preset);
      Simulation simulation(preset);
      check_bound(simulation, test::fewer(600, 100));
    }
}

TEST_CASE("where springs cannot tear, energy from errors of the method is no divergence, but it is told" *
          doctest::test_suite("slow")) {
  Preset preset = test::cloth(10, 10, "implicit_midpoint");
  preset.pins.mode = Pins::Mode::none, preset.k_d = 0, preset.k_s = 1e4, preset.dt = 0.01;
  Simulation coarse(preset);
  CHECK_FALSE(coarse.advance(200).diverged);
  CHECK(coarse.excess() > 100);
  CHECK(energy_in_excess(coarse.excess(), preset).find("times the energy the scene can supply") != std::string::npos);
  preset.integrator = "verlet", preset.dt = 9e-5;
  Simulation fine(preset);
  fine.advance(test::fewer(22222));
  CHECK(fine.excess() <= 1.02);
  CHECK(energy_in_excess(fine.excess(), preset).empty());
}

TEST_CASE("springs that hold much before they tear leave no room for an explosion") {
  Preset preset;
  preset.F_max = 10, preset.k_d = 0.005, preset.m = 3e-5, preset.k_s = 1, preset.dt = 1e-3;
  Simulation simulation(preset);
  CHECK(simulation.advance(1000).diverged);
  CHECK(simulation.divergence()->cause.find("times the energy the scene can supply") != std::string::npos);
  CHECK(simulation.energy().energy.kinetic < 1);
}

TEST_CASE("wind and weight may go on for an hour") {
  Preset preset = tearing(3, 3, "verlet");
  preset.W = {0, 0, 0.01}, preset.F_max = 0.5, preset.dt = 1e-3;
  Simulation simulation(preset);
  CHECK_FALSE(simulation.advance(400000).diverged);
  CHECK(glm::length(test::velocity(simulation.read(), 4)) > 1e3);
}

TEST_CASE("gusts, the hand, cuts, bodies that are moved, and changed constants give what they give") {
  for (const std::string& name : methods_in_question()) {
    CAPTURE(name);
    Preset preset = tearing(9, 8, name);
    preset.F_max = 0.2, preset.W = {0.01, 0, 0.02}, preset.gust = 0.8, preset.gust_period = 0.02;
    preset.bodies = {Body{}};
    preset.bodies[0].c = preset.x_0, preset.bodies[0].r = 0.09;  // it begins inside
    Simulation simulation(preset);
    simulation.advance(100);
    simulation.apply(edit::Grab{4, 4});
    simulation.apply(edit::MoveHand{preset.x_0 + glm::dvec3(0.5, 1, 0.5), 100});
    simulation.advance(150);
    simulation.apply(edit::Release{});
    simulation.apply(edit::MoveBody{0, simulation.position(7, 2)});
    simulation.advance(50);
    simulation.apply(edit::Cut{{{5, 1}, {5, 2}, {5, 3}}});
    Preset next = simulation.preset();
    next.L *= 0.7, next.m /= 2, next.k_s *= 1.5;
    simulation.apply(edit::Change{next});
    simulation.advance(200);
    simulation.apply(edit::Pin{2, 2, true});
    simulation.advance(50);
    CHECK_FALSE(simulation.divergence().has_value());
  }
}

TEST_CASE("the bound grows with time as it is derived") {
  Preset p;
  p.rows = 4, p.columns = 4, p.g = 10, p.W = {0, 0, 3e-4}, p.m = 1e-3, p.F_max = 1e-9, p.k_b = 0, p.dt = 0.1;
  MotionLimit limit;
  limit.set_scene(p, {4, 4}, false, {});
  limit.begin({9, 2, 0});
  for (int n = 0; n < 10; ++n) limit.pass(0.1);
  const double U = 3 + 4 * (10 + 8.0 / 3 * 3e-4 / 1e-3) * 1.0;
  CHECK(limit.most_squared() == doctest::Approx(MotionLimit::factor * U * U));
  CHECK(limit.farthest() > 2);
  // All sixteen at that speed are just within it; the elongation of a step is twice what a particle can move.
  const double speed = std::sqrt(limit.most_squared() / 16);
  CHECK_FALSE(limit.may_be_exceeded(2 * 0.999 * speed * 0.1, 0.1));
  CHECK(limit.may_be_exceeded(2 * 1.001 * speed * 0.1, 0.1));
}

}  // namespace tyglab::motion_limit_test
