// Shapes, tilted planes and bodies that move (core/forces/contact.h) against closed forms. Motions of single particles
// on them, and the capstan, are cases of `tyglab verify` (core/verify/contact.cpp).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/forces/contact.h"
#include "core/integrators/scheme.h"
#include "core/model/words.h"
#include "tests/support/scenes.h"

namespace tyglab::bodies_test {

using Shape = Body::Shape;
constexpr double g = 9.82;

/// A particle that no spring pulls, at (0, 0); another hangs from the sky far above, out of the way.
Preset particle(const std::string& integrator, glm::dvec3 x, glm::dvec3 v) {
  Preset preset = test::quiet_cloth(2, 1, integrator);
  preset.k_s = 0, preset.g = g, preset.dt = 1e-3;
  preset.x_0 = x, preset.v_0 = v;
  preset.tilt_deg = -90;
  preset.L = 10;
  return preset;
}

Body body_of(Shape shape, double friction = 0, double restitution = 0) {
  Body body;
  body.shape = shape;
  body.friction = friction, body.restitution = restitution;
  return body;
}

glm::dvec3 x_of(Simulation& simulation) {
  return test::position(simulation.read(), 0);
}
glm::dvec3 v_of(Simulation& simulation) {
  return test::velocity(simulation.read(), 0);
}

const std::vector<std::string> second_order{"verlet", "velocity_verlet",   "rk4",    "rkn4", "force_gradient4",
                                            "dopri5", "implicit_midpoint", "tr_bdf2"};
constexpr Shape solids[] = {Shape::sphere, Shape::box, Shape::capsule, Shape::cylinder};

/// What is inside, by the definition of each shape.
bool inside(const Body& b, glm::dvec3 q) {
  switch (b.shape) {
    case Shape::sphere:
      return glm::length(q) < b.r;
    case Shape::box:
      return std::abs(q.x) < b.size.x / 2 && std::abs(q.y) < b.size.y / 2 && std::abs(q.z) < b.size.z / 2;
    case Shape::cylinder:
      return std::hypot(q.x, q.z) < b.r && std::abs(q.y) < b.length / 2;
    case Shape::capsule:
      return glm::length(q - glm::dvec3(0, std::clamp(q.y, -b.length / 2, b.length / 2), 0)) < b.r;
    case Shape::plane:
      return q.y < 0;
  }
  return false;
}

TEST_CASE("a body's distance is that of its nearest point, and its normal leads there") {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> in(-1, 1);
  for (const Shape shape : {Shape::sphere, Shape::box, Shape::capsule, Shape::cylinder, Shape::plane}) {
    Body body = body_of(shape);
    body.c = {0.3, -0.2, 0.1}, body.r = 0.3, body.size = {0.5, 0.3, 0.8}, body.length = 0.7, body.y = -0.2;
    if (shape != Shape::sphere) body.turn = {20, -50, 130};
    const PlacedBody at = placed(body);
    const glm::dvec3 c = shape == Shape::plane ? glm::dvec3(0, body.y, 0) : body.c;
    // About x, then y, then z.
    const glm::dmat3 turn = glm::mat3_cast(glm::angleAxis(glm::radians(body.turn.z), glm::dvec3(0, 0, 1)) *
                                           glm::angleAxis(glm::radians(body.turn.y), glm::dvec3(0, 1, 0)) *
                                           glm::angleAxis(glm::radians(body.turn.x), glm::dvec3(1, 0, 0)));
    CAPTURE(name_of(shape));
    for (int n = 0; n < 300; ++n) {
      const glm::dvec3 x(in(random), in(random), in(random));
      const glm::dvec3 q = glm::transpose(turn) * (x - c);
      const double gap = -depth(at, x);
      CHECK((gap < 0) == inside(body, q));
      const glm::dvec3 normal = body_normal(at, x), foot = x - gap * normal;
      CHECK(std::abs(glm::length(normal) - 1) < 1e-12);
      CHECK(std::abs(depth(at, foot)) < 1e-12);
      // Nothing of the other side is nearer: a ball of that radius round x holds none of it.
      for (int k = 0; k < 20; ++k) {
        const glm::dvec3 way(in(random), in(random), in(random));
        const glm::dvec3 near = q + 0.999 * std::abs(gap) * glm::normalize(way);
        CHECK(inside(body, near) == (gap < 0));
      }
    }
  }
}

TEST_CASE("a conveyor belt does the work that the speed of what it drags along needs") {
  for (const std::string& method : second_order) {
    CAPTURE(method);
    constexpr double friction = 0.4, speed = 1.5;
    Preset preset = particle(method, {0, 0, 0}, {0, 0, 0});
    Body belt = body_of(Shape::plane, friction);
    belt.velocity = {speed, 0, 0};
    preset.bodies = {belt};
    Simulation dragged(preset);
    dragged.enable_ledger(true);
    dragged.advance(int(0.6 * speed / (friction * g) / preset.dt));
    const double reached = friction * g * dragged.time();
    CHECK(dragged.ledger()->works.contact / (preset.m * std::pow(reached, 2) / 2) == doctest::Approx(1).epsilon(1e-3));
    CHECK(std::abs(dragged.ledger()->made()) < 1e-3 * preset.m * speed * speed);
  }
}

TEST_CASE("a particle that falls on a body of any shape, turned, never gets into it") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1, 1);
  for (const Shape shape : solids)
    for (const Scheme& method : schemes())
      for (int n = 0; n < 4; ++n) {
        CAPTURE(name_of(shape));
        CAPTURE(method.name);
        Preset preset = particle(std::string(method.name), {0.2 * in(random), 0.9, 0.2 * in(random)},
                                 {in(random), -3 + 60 * (in(random) > 0 ? -1 : 0), in(random)});
        Body body = body_of(shape, 0.3, 0.4);
        body.r = 0.3, body.size = {0.5, 0.3, 0.4}, body.length = 0.3;
        if (shape != Shape::sphere) body.turn = {180 * in(random), 180 * in(random), 180 * in(random)};
        body.spin = {5 * in(random), 5 * in(random), 5 * in(random)};
        body.velocity = {0.2 * in(random), 0.5 * in(random), 0.2 * in(random)};
        preset.dt = 4e-3;
        preset.bodies = {body};
        Simulation simulation(preset);
        for (int step = 0; step < 200; ++step) {
          simulation.advance(1);
          const PlacedBody now = placed_bodies(preset.bodies, simulation.time(), preset.dt, 1e-16).front();
          REQUIRE(depth(now, x_of(simulation)) < 1e-9);
        }
      }
}

TEST_CASE("a body follows its path, and edits shift it from where it is") {
  Preset preset = test::quiet_cloth(3, 3);
  Body ball = body_of(Shape::sphere);
  ball.path = {{0.1, {0, 0, 0}}, {0.3, {1, 0, 0}}, {0.5, {1, 2, 0}}};
  preset.bodies = {ball};
  Simulation simulation(preset);
  CHECK(simulation.bodies()[0].c == glm::dvec3(0, 0, 0));
  simulation.advance(200);
  CHECK(glm::length(simulation.bodies()[0].c - glm::dvec3(0.5, 0, 0)) < 1e-9);
  simulation.advance(200);
  CHECK(glm::length(simulation.bodies()[0].c - glm::dvec3(1, 1, 0)) < 1e-9);
  simulation.apply(edit::MoveBody{0, {5, 1, 0}});
  CHECK(glm::length(simulation.bodies()[0].c - glm::dvec3(5, 1, 0)) < 1e-9);
  simulation.advance(1000);
  CHECK(glm::length(simulation.bodies()[0].c - glm::dvec3(5, 2, 0)) < 1e-9);
  simulation.apply(edit::Restart{});
  CHECK(glm::length(simulation.bodies()[0].c - glm::dvec3(4, 0, 0)) < 1e-9);
}

TEST_CASE("a body that is dragged has the velocity of the drag, and none when it has arrived") {
  for (const int rounds : {1, 3}) {
    Preset preset = particle("verlet", {0, 0, 0}, {0, 0, 0});
    preset.g = 0;
    Body ball = body_of(Shape::sphere, 0, 0.5);
    ball.r = 0.1, ball.c = {-0.2, 0, 0};
    preset.bodies = {ball};
    Simulation simulation(preset);
    simulation.enable_ledger(true);
    // 0.15 m in 90 ms, in a drag of one or three frames: it meets the particle after two thirds.
    for (int n = 1; n <= rounds; ++n) {
      simulation.apply(edit::MoveBody{0, {-0.2 + 0.15 * n / rounds, 0, 0}, 90 / rounds});
      simulation.advance(90 / rounds);
    }
    const double speed = 0.15 / 0.09;
    CHECK(v_of(simulation).x == doctest::Approx(1.5 * speed).epsilon(1e-9));
    CHECK(simulation.ledger()->works.contact == doctest::Approx(preset.m * std::pow(1.5 * speed, 2) / 2).epsilon(1e-6));
    CHECK(simulation.preset().bodies[0].c.x == doctest::Approx(-0.05));
    CHECK(simulation.preset().bodies[0].path.empty());
    simulation.advance(100);
    CHECK(simulation.bodies()[0] == simulation.preset().bodies[0]);
  }
}

/// Where a particle is that has slid on a sphere for 0.4 s, which spins.
glm::dvec3 slid(const std::string& integrator, double dt, double spin, double friction) {
  const double at = 0.1;
  Preset preset = particle(integrator, {0.5 * std::sin(at), 0.5 * std::cos(at), 0}, {});
  preset.g = 9.82, preset.dt = dt;
  Body body;
  body.c = {0, 0, 0}, body.r = 0.5, body.spin = {0, spin, 0}, body.friction = friction;
  preset.bodies = {body};
  Simulation simulation(preset);
  simulation.advance(int(std::lround(0.4 / dt)));
  return simulation.position(0, 0);
}

TEST_CASE("a sphere that spins without friction is one at rest, and friction on it keeps order 2") {
  for (const char* integrator : {"verlet", "rk4"}) {
    const glm::dvec3 rests = slid(integrator, 1e-3, 0, 0);
    CHECK(glm::distance(slid(integrator, 1e-3, 20, 0), rests) < 1e-4);
    CHECK(glm::distance(slid(integrator, 5e-4, 20, 0), slid(integrator, 5e-4, 0, 0)) < 3e-5);
    for (const double friction : {0.05, 0.5}) {
      const glm::dvec3 coarse = slid(integrator, 2e-3, 20, friction), middle = slid(integrator, 1e-3, 20, friction),
                       fine = slid(integrator, 5e-4, 20, friction);
      CHECK(glm::distance(coarse, middle) > 3 * glm::distance(middle, fine));
      CHECK(glm::distance(fine, rests) > 1e-3);
    }
  }
}

TEST_CASE("a body that spins is turned by angles about x, y and z as much as it has spun") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-1, 1);
  for (int n = 0; n < 50; ++n) {
    Body body = body_of(Shape::box);
    body.turn = {180 * in(random), 180 * in(random), 180 * in(random)};
    body.spin = {3 * in(random), 3 * in(random), 3 * in(random)}, body.velocity = {1, 2, 3};
    const double t = 2 * in(random);
    const PlacedBody moved = placed_bodies({&body, 1}, t, 1e-3, 1e-16).front(), rests = placed(body_at(body, t));
    for (int k = 0; k < 9; ++k) CHECK(std::abs(moved.axes[k] - rests.axes[k]) < 1e-9);
    for (int k = 0; k < 3; ++k) CHECK(moved.c[k] == doctest::Approx(rests.c[k]));
  }
}

TEST_CASE("steps with bodies that move are the same one by one, together, and on several threads") {
  for (const std::string method : {"verlet", "rk4", "dopri5", "implicit_euler"}) {
    CAPTURE(method);
    Preset preset = test::cloth(64, 48);
    preset.integrator = method, preset.dt = 5e-4;
    preset.pins.mode = Pins::Mode::none;
    Body drum = body_of(Shape::cylinder, 0.3, 0.2), floor = body_of(Shape::plane, 0.4, 0.5);
    drum.c = preset.x_0 + glm::dvec3(0.3, -0.2, 0.2), drum.turn = {0, 30, 90}, drum.spin = {3, 1, 0}, drum.r = 0.1;
    drum.velocity = {0, 0.5, 0.1};
    floor.y = preset.x_0.y - 0.4, floor.turn = {5, 0, 3}, floor.velocity = {0, 0.3, 0};
    preset.bodies = {drum, floor};
    Simulation together(preset, 1), threads(preset, 2), single(preset, 1);
    together.advance(600), threads.advance(600);
    for (int n = 0; n < 600; ++n) single.advance(1);
    CHECK(test::identical(together.read(), threads.read()));
    CHECK(test::identical(together.read(), single.read()));
  }
}

}  // namespace tyglab::bodies_test
