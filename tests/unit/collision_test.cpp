// Collisions with fixed bodies (2.1.5) as invariants, at the ends of steps where nothing else is said; exact agreement
// is oracle/agreement_test.cpp, and contact within steps analytic/contact_test.cpp.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/support/sanitized.h"

#include "tests/support/scenes.h"

namespace tyglab::collision_test {

Body sphere(glm::dvec3 c, double r) {
  Body body;
  body.c = c;
  body.r = r;
  return body;
}

Body plane(double y) {
  Body body;
  body.shape = Body::Shape::plane;
  body.y = y;
  return body;
}

/// Two particles far from each other's springs: one row of interest, x_0 at its particle (0, 0). No gravity.
Preset shot(const std::string& integrator, glm::dvec3 from, glm::dvec3 v) {
  Preset preset = test::quiet_cloth(2, 1, integrator);
  preset.k_s = 0;
  preset.dt = 1e-3;
  preset.contact = "step";
  preset.x_0 = from;
  preset.v_0 = v;
  preset.tilt_deg = -90;  // the second particle stands above the first
  preset.L = 0.5;
  return preset;
}

/// Largest depth of a free particle inside a body, in ulp of the run's precision of max(|x|, |c|, r).
double worst_depth_in_ulp(Simulation& simulation) {
  const Preset& preset = simulation.preset();
  const double epsilon = preset.precision == Precision::float_ ? std::numeric_limits<float>::epsilon()
                                                               : std::numeric_limits<double>::epsilon();
  double worst = 0;
  const State& state = simulation.read();
  for (int p = 0; p < simulation.lattice().size(); ++p) {
    if (simulation.pinned(p / preset.columns, p % preset.columns)) continue;
    const glm::dvec3 x = test::position(state, p);
    for (const Body& body : preset.bodies) {
      const bool round = body.shape == Body::Shape::sphere;
      const double depth = round ? body.r - glm::length(x - body.c) : body.y - x.y;
      const double size =
          round ? std::max({glm::length(x), glm::length(body.c), body.r}) : std::max(glm::length(x), std::abs(body.y));
      // The ulp of `size`: epsilon times the power of two below it.
      worst = std::max(worst, depth / (epsilon * std::exp2(std::floor(std::log2(size)))));
    }
  }
  return worst;
}

const char* const methods[] = {"verlet", "euler",         "improved_euler",      "rk4", "dopri5",
                               "rkc2",   "damped_verlet", "projective_dynamics", "vbd", "xpbd"};

TEST_CASE("a plane takes the normal velocity and leaves the tangential one") {
  for (const char* integrator : methods) {
    CAPTURE(std::string(integrator));
    Preset preset = shot(integrator, {0, 0.0105, 0}, {2, -1, 0.5});
    preset.bodies = {plane(0)};
    Simulation simulation(preset);
    simulation.advance(30);
    const State& state = simulation.read_raw();
    CHECK(state.v.y[0] == doctest::Approx(0).epsilon(1e-12));
    CHECK(state.v.x[0] == doctest::Approx(2));
    CHECK(state.v.z[0] == doctest::Approx(0.5));
    CHECK(state.x.x[0] == doctest::Approx(0.06));
    CHECK(state.x.y[0] == doctest::Approx(0.0005));  // it stopped where it was before the step that struck
  }
}

TEST_CASE("restitution reverses e of the normal velocity") {
  for (const char* integrator : methods) {
    Preset preset = shot(integrator, {0, 0.0105, 0}, {2, -1, 0});
    preset.bodies = {plane(0)};
    preset.bodies[0].restitution = 0.75;
    Simulation simulation(preset);
    simulation.advance(20);
    CHECK(simulation.read_raw().v.y[0] == doctest::Approx(0.75));
    CHECK(simulation.read_raw().v.x[0] == doctest::Approx(2));
  }
}

TEST_CASE("Coulomb friction shortens the tangential velocity by mu times the change of the normal one") {
  for (const char* integrator : methods) {
    for (const double e : {0.0, 0.5}) {
      Preset preset = shot(integrator, {0, 0.0105, 0}, {3, -1, 4});
      preset.bodies = {plane(0)};
      preset.bodies[0].friction = 0.8;
      preset.bodies[0].restitution = e;
      Simulation simulation(preset);
      simulation.advance(12);
      const double kept = 1 - 0.8 * (1 + e) / 5;
      CHECK(simulation.read_raw().v.x[0] == doctest::Approx(3 * kept));
      CHECK(simulation.read_raw().v.z[0] == doctest::Approx(4 * kept));
      // At most: a large μ stops it, and never turns it round.
      preset.bodies[0].friction = 10;
      Simulation rough(preset);
      rough.advance(12);
      CHECK(std::abs(rough.read_raw().v.x[0]) < 1e-12);
    }
  }
}

TEST_CASE("a sphere's normal is that of the old position") {
  for (const char* integrator : methods) {
    // Straight down at a quarter of the sphere: N = (1, 1, 0)/√2 where it strikes.
    const double r = 0.2, x = r / std::sqrt(2.0);
    Preset preset = shot(integrator, {x, x + 0.01 + 1e-5, 0}, {0, -1, 0});
    preset.bodies = {sphere({0, 0, 0}, r)};
    Simulation simulation(preset);
    simulation.advance(11);
    const glm::dvec3 v = test::velocity(simulation.read_raw(), 0);
    CHECK(glm::length(v - glm::dvec3(0.5, -0.5, 0)) < 5e-3);
    CHECK(glm::dot(v, glm::dvec3(x, x + 1e-5, 0)) == doctest::Approx(0).epsilon(1e-9));
  }
}

TEST_CASE("no free particle is left inside by more than 8 ulp, whatever falls on what" * doctest::test_suite("slow")) {
  for (const char* integrator : methods) {
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      for (const double e : {0.0, 0.4, 0.8}) {
        if (test::sanitized && (e > 0) != (precision == Precision::float_)) continue;
        CAPTURE(std::string(integrator));
        CAPTURE(e);
        Preset preset = test::cloth(11, 11, integrator);
        preset.dt = 2e-4;
        preset.contact = e < 0.5 ? "step" : "local";
        preset.k_s = 5;  // Euler is stable here: dt < k_d/k_s
        preset.precision = precision;
        preset.pins.mode = Pins::Mode::none;
        preset.tilt_deg = 3;
        preset.x_0 = {0.02, 0.33, -0.2};
        preset.v_0 = {0, -3, 0};
        preset.bodies = {sphere({0, 0.15, 0}, 0.15), plane(0)};
        for (Body& body : preset.bodies) body.friction = 0.3, body.restitution = e;
        Simulation simulation(preset);
        double worst = 0;
        for (int look = 0; look < 160; ++look) {
          simulation.advance(5);
          worst = std::max(worst, worst_depth_in_ulp(simulation));
        }
        CHECK_FALSE(simulation.divergence().has_value());
        CHECK(worst <= 8);
        CHECK(worst_depth_in_ulp(simulation) > -1e3);
      }
    }
  }
}

TEST_CASE("a particle at rest on a plane stays at rest, and keeps friction") {
  for (const char* integrator : methods) {
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      CAPTURE(std::string(integrator));
      Preset preset = shot(integrator, {0.1, 0.3, 0.1}, {1, 0, 0});
      preset.precision = precision;
      preset.g = 9.82;
      preset.bodies = {plane(0.3)};
      preset.bodies[0].friction = 0.5;
      Simulation simulation(preset);
      simulation.advance(100);
      const double v = simulation.read_raw().v.x[0];
      // It slides and loses μ g a second.
      CHECK(v == doctest::Approx(1 - 0.5 * 9.82 * 0.1).epsilon(0.03));
      simulation.advance(400);
      CHECK(std::abs(simulation.read_raw().v.x[0]) < 1e-6);
      CHECK(simulation.read().x.y[0] == doctest::Approx(0.3).epsilon(1e-5));
      CHECK(worst_depth_in_ulp(simulation) <= 8);
    }
  }
}

TEST_CASE("a ball that is dropped rests when its bounces would have ended, and bounces on where nothing is lost" *
          doctest::test_suite("slow")) {
  constexpr double height = 0.3, g = 9.82;
  const auto dropped = [](const char* integrator, double e) {
    Preset preset = shot(integrator, {0, height, 0}, {0, 0, 0});
    preset.g = g;
    preset.bodies = {plane(0)};
    preset.bodies[0].restitution = e;
    return preset;
  };
  for (const char* integrator : methods) {
    for (const double e : {0.2, 0.5, 0.8, 0.9}) {
      CAPTURE(std::string(integrator));
      CAPTURE(e);
      const Preset preset = dropped(integrator, e);
      const double rest = std::sqrt(2 * height / g) * (1 + e) / (1 - e);  // s: fall and bounces, a geometric series
      Simulation simulation(preset);
      simulation.advance(int(1.5 * rest / preset.dt));
      for (int look = 0; look < 50; ++look) {
        simulation.advance(1);
        CHECK(simulation.read().x.y[0] < 3 * g * preset.dt * preset.dt);
        CHECK(std::abs(simulation.read_raw().v.y[0]) < 2 * g * preset.dt);
      }
    }
    Simulation elastic(dropped(integrator, 1));
    elastic.advance(5000);
    double highest = 0;
    for (int look = 0; look < 600; ++look) {
      elastic.advance(1);
      highest = std::max(highest, elastic.read().x.y[0]);
    }
    CHECK(highest > 0.9 * height);
  }
}

TEST_CASE("a start inside is projected to the nearest surface without a kick") {
  for (const char* integrator : methods) {
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      CAPTURE(std::string(integrator));
      Preset preset = shot(integrator, {0.1, 0.05, 0}, {0, 0, 0});
      preset.precision = precision;
      preset.bodies = {sphere({0, 0, 0}, 0.2)};
      preset.bodies[0].restitution = 1;
      preset.bodies[0].friction = 1;
      Simulation simulation(preset);
      simulation.advance(1);
      const glm::dvec3 x = test::position(simulation.read(), 0);
      CHECK(glm::length(x) == doctest::Approx(0.2).epsilon(1e-6));
      CHECK(glm::length(x - 0.2 * glm::normalize(glm::dvec3(0.1, 0.05, 0))) < 1e-6);
      CHECK(worst_depth_in_ulp(simulation) <= 8);
      simulation.advance(100);
      CHECK(glm::length(test::position(simulation.read(), 0) - x) < 1e-5);
      CHECK(glm::length(test::velocity(simulation.read_raw(), 0)) < 1e-4);
    }
  }
}

TEST_CASE("a start inside keeps the tangential and outward velocity and loses the inward one") {
  for (const char* integrator : methods) {
    Preset preset = shot(integrator, {0, -0.1, 0}, {0.2, -1, 0.3});
    preset.bodies = {plane(0)};
    preset.bodies[0].friction = 1;
    preset.bodies[0].restitution = 1;
    Simulation in(preset);
    in.advance(1);
    CHECK(glm::length(test::velocity(in.read_raw(), 0) - glm::dvec3(0.2, 0, 0.3)) < 1e-9);
    preset.v_0 = {0.2, 1, 0.3};
    Simulation out(preset);
    out.advance(1);
    CHECK(glm::length(test::velocity(out.read_raw(), 0) - glm::dvec3(0.2, 1, 0.3)) < 1e-9);
  }
}

TEST_CASE("from a sphere's center the way out is up") {
  for (const char* integrator : methods) {
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      CAPTURE(std::string(integrator));
      Preset preset = shot(integrator, {0.5, 0.25, -0.5}, {0, 0, 0});
      preset.g = 9.82;
      preset.precision = precision;
      preset.bodies = {sphere(preset.x_0, 0.25)};
      Simulation simulation(preset);
      simulation.advance(1);
      const glm::dvec3 x = test::position(simulation.read(), 0);
      CHECK(glm::length(x - glm::dvec3(0.5, 0.5, -0.5)) < 1e-5);
      CHECK(test::all_finite(simulation.read()));
    }
  }
}

TEST_CASE("a body moved onto the cloth pushes it out within a step, without a blow-up") {
  for (const char* integrator : methods) {
    Preset preset = test::cloth(10, 10, integrator);
    preset.contact = std::string_view(integrator) == "rk4" ? "step" : "local";
    preset.dt = 1e-4;
    preset.bodies = {sphere({0, 5, 0}, 0.1)};
    Simulation simulation(preset);
    simulation.advance(100);
    simulation.apply(edit::MoveBody{0, {0, 0.85, 0.02}});
    CHECK(simulation.preset().bodies[0].c == glm::dvec3(0, 0.85, 0.02));
    const AdvanceResult advance = simulation.advance(1);
    CHECK(advance.left_inside == 0);
    CHECK(worst_depth_in_ulp(simulation) <= 8);
    simulation.advance(500);
    CHECK_FALSE(simulation.divergence().has_value());
    CHECK(worst_depth_in_ulp(simulation) <= 8);
  }
}

TEST_CASE("overlapping bodies: what cannot be resolved is reported, nothing is NaN") {
  for (const char* integrator : methods) {
    CAPTURE(std::string(integrator));
    // A sphere sunk into the ground: a particle between them has a way out.
    Preset preset = test::cloth(8, 8, integrator);
    preset.dt = 5e-4;
    preset.pins.mode = Pins::Mode::none;
    preset.tilt_deg = 0;
    preset.x_0 = {0, 0.3, -0.1};
    preset.v_0 = {0, -2, 0};
    preset.bodies = {sphere({0, 0.02, 0}, 0.15), plane(0)};
    Simulation simulation(preset);
    for (int step = 0; step < 600; ++step) {
      const AdvanceResult advance = simulation.advance(1);
      CHECK(advance.left_inside == 0);
    }
    CHECK(worst_depth_in_ulp(simulation) <= 8);

    // Two spheres, each holding the other's way out: a particle in the middle can be stuck, and then it is counted.
    Preset stuck = shot(integrator, {0, 0.1, 0}, {0, -1, 0});
    stuck.bodies = {sphere({0, 0, 0}, 0.3), sphere({0, 0.4, 0}, 0.35), plane(2)};
    Simulation crowded(stuck);
    AdvanceResult last;
    for (int step = 0; step < 50; ++step) last = crowded.advance(1);
    CHECK(test::all_finite(crowded.read()));
    CHECK((last.left_inside == 0) == (worst_depth_in_ulp(crowded) <= 8));
  }
}

TEST_CASE("bodies do not touch pinned or held particles") {
  Preset preset = test::cloth(5, 5);
  preset.bodies = {sphere(preset.x_0, 0.3)};
  preset.pins.mode = Pins::Mode::top_row;
  Simulation simulation(preset);
  const glm::dvec3 corner = test::position(simulation.read(), 0);
  simulation.advance(10);
  CHECK(test::position(simulation.read(), 0) == corner);
  simulation.apply(edit::Grab{4, 2});
  simulation.apply(edit::MoveHand{preset.x_0, 20});
  simulation.advance(20);
  CHECK(glm::length(test::position(simulation.read(), 22) - preset.x_0) < 1e-12);
}

TEST_CASE("a particle on a body says so, one beside it, above it or held does not") {
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    for (const char* integrator : {"verlet", "velocity_verlet", "rk4"}) {
      CAPTURE(std::string(integrator));
      // Flat, falling on a small sphere under its middle.
      Preset preset = test::cloth(9, 9, integrator);
      preset.precision = precision;
      preset.pins.mode = Pins::Mode::none;
      preset.tilt_deg = 0;
      preset.x_0 = {0, 0.3, -4 * preset.L};
      preset.dt = 5e-4;
      preset.bodies = {sphere({0, 0.24, 0}, 0.05), plane(-5)};
      preset.bodies[0].friction = 1;
      Simulation simulation(preset);
      CHECK_FALSE(simulation.particle(4, 4).on_body);
      simulation.advance(400);
      // The cloth trembles: at times its springs lift a particle off.
      int on = 0;
      for (int step = 0; step < 40; ++step) simulation.advance(1), on += simulation.particle(4, 4).on_body;
      REQUIRE_FALSE(simulation.divergence().has_value());
      CHECK(on >= 30);
      CHECK_FALSE(simulation.particle(0, 0).on_body);
      simulation.apply(edit::Pin{4, 4, true});
      CHECK_FALSE(simulation.particle(4, 4).on_body);
      simulation.apply(edit::Pin{4, 4, false});
      simulation.apply(edit::MoveBody{0, {0, -1, 0}});
      CHECK_FALSE(simulation.particle(4, 4).on_body);
    }
  }
}

}  // namespace tyglab::collision_test
