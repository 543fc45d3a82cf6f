// Shapes, tilted planes and bodies that move (core/forces/contact.h) against closed forms.
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

TEST_CASE("on a tilted plane a particle slides with g (sin θ − μ cos θ), or sticks") {
  for (const std::string& method : second_order) {
    for (const double friction : {0.0, 0.3, 0.7}) {
      CAPTURE(method);
      CAPTURE(friction);
      constexpr double slope = 30 * 3.14159265358979323846 / 180;
      const glm::dvec3 down(std::cos(slope), -std::sin(slope), 0);
      Preset preset = particle(method, {0, 0.2, 0}, {0, 0, 0});
      Body plane = body_of(Shape::plane, friction);
      plane.y = 0.2, plane.turn = {0, 0, -30};
      preset.bodies = {plane};
      Simulation simulation(preset);
      simulation.advance(500);
      const double t = simulation.time(), a = g * std::max(0.0, std::sin(slope) - friction * std::cos(slope));
      const glm::dvec3 expected = glm::dvec3(0, 0.2, 0) + a * t * t / 2 * down;
      CHECK(glm::length(x_of(simulation) - expected) < 1e-9);
      CHECK(glm::length(v_of(simulation) - a * t * down) < 1e-9);
    }
  }
}

TEST_CASE("a conveyor belt drags along, a lift carries, and both do work") {
  for (const std::string& method : second_order) {
    CAPTURE(method);
    constexpr double friction = 0.4, speed = 1.5;
    Preset preset = particle(method, {0, 0, 0}, {0, 0, 0});
    Body belt = body_of(Shape::plane, friction);
    belt.velocity = {speed, 0, 0};
    preset.bodies = {belt};
    Simulation dragged(preset);
    dragged.enable_ledger(true);
    const double until = speed / (friction * g);
    dragged.advance(int(0.6 * until / preset.dt));
    const double t = dragged.time();
    CHECK(std::abs(x_of(dragged).x - friction * g * t * t / 2) < 1e-9);
    CHECK(std::abs(v_of(dragged).x - friction * g * t) < 1e-9);
    CHECK(dragged.ledger()->works.contact / (preset.m * std::pow(friction * g * t, 2) / 2) ==
          doctest::Approx(1).epsilon(1e-3));
    CHECK(std::abs(dragged.ledger()->made()) < 1e-3 * preset.m * speed * speed);
    dragged.advance(1000);
    CHECK(std::abs(v_of(dragged).x - speed) < 1e-9);
    CHECK(std::abs(x_of(dragged).x - (speed * dragged.time() - speed * speed / (2 * friction * g))) < 2e-6);

    belt.velocity = {0, 0.7, 0};
    preset.bodies = {belt};
    Simulation lifted(preset);
    lifted.advance(300);
    CHECK(std::abs(x_of(lifted).y - 0.7 * lifted.time()) < 1e-12);
    CHECK(std::abs(v_of(lifted).y - 0.7) < 1e-9);
  }
}

TEST_CASE("a ball that flies into a particle throws it ahead at (1 + e) times its speed") {
  for (const Scheme& method : schemes()) {
    for (const double speed : {3.0, 90.0}) {
      CAPTURE(method.name);
      CAPTURE(speed);
      constexpr double e = 0.5;
      Preset preset = particle(std::string(method.name), {0, 0, 0}, {0, 0, 0});
      preset.g = 0;
      Body ball = body_of(Shape::sphere, 0.3, e);
      // At 90 m/s it passes through the particle's place within one step.
      ball.r = 0.02, ball.c = {-1.0, 0, 0}, ball.velocity = {speed, 0, 0};
      preset.bodies = {ball};
      Simulation simulation(preset);
      const double meets = (1.0 - ball.r) / speed, t = 2 * meets;
      simulation.advance(int(std::ceil(t / preset.dt)));
      CHECK(v_of(simulation).x == doctest::Approx((1 + e) * speed).epsilon(1e-9));
      if (method.order_undamped >= 2)
        CHECK(x_of(simulation).x == doctest::Approx((1 + e) * speed * (simulation.time() - meets)).epsilon(1e-6));
    }
  }
}

TEST_CASE("a turntable carries what friction holds on it around, and loses what it does not") {
  for (const std::string& method : second_order) {
    CAPTURE(method);
    const auto off_after = [&](double friction, double dt) {
      constexpr double radius = 0.5, rate = 3;
      Preset preset = particle(method, {radius, 0, 0}, {0, 0, -rate * radius});
      preset.dt = dt;
      Body table = body_of(Shape::plane, friction);
      table.spin = {0, rate, 0};
      preset.bodies = {table};
      Simulation simulation(preset);
      simulation.advance(int(std::lround(1 / dt)));
      const double angle = rate * simulation.time();
      return glm::length(x_of(simulation) - glm::dvec3(radius * std::cos(angle), 0, -radius * std::sin(angle)));
    };
    // It holds ω² r = 4.5 m/s² from μ = 0.458 on.
    const double coarse = off_after(0.6, 4e-3), fine = off_after(0.6, 2e-3);
    CHECK(fine < 1e-4);
    CHECK(coarse / std::max(fine, 1e-12) > 3);
    CHECK(off_after(0.4, 2e-3) > 0.05);
  }
}

TEST_CASE("what slides over the edge of a box falls on as a free particle does") {
  for (const std::string& method : second_order) {
    CAPTURE(method);
    Preset preset = particle(method, {0, 0.25, 0}, {1, 0, 0});
    Body box = body_of(Shape::box);
    box.size = {0.4, 0.5, 0.4};
    preset.bodies = {box};
    Simulation simulation(preset);
    simulation.advance(150);
    CHECK(x_of(simulation).y == 0.25);
    CHECK(std::abs(x_of(simulation).x - 0.15) < 1e-12);
    simulation.advance(250);
    const double fallen = simulation.time() - 0.2;
    CHECK(std::abs(x_of(simulation).x - 0.4) < 1e-12);
    // Within the step in which it leaves it is held until its end.
    CHECK(std::abs(x_of(simulation).y - (0.25 - g * fallen * fallen / 2)) < 1.1 * g * fallen * preset.dt);
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

/// A thread over a drum that turns under it, held at both ends, without weight: the tension on one side over that on
/// the other is e^{μθ} (Euler and Eytelwein).
TEST_CASE("the capstan: T₂/T₁ = e^{μθ}" * doctest::test_suite("slow")) {
  constexpr int particles = 61;
  for (const double friction : {0.1, 0.3}) {
    CAPTURE(friction);
    Preset preset = test::quiet_cloth(particles, 1);
    preset.L = 1.0 / 60, preset.m = 2e-4, preset.k_s = 200, preset.k_d = 0.2, preset.dt = 1e-4, preset.tilt_deg = 0;
    // Along z, from -0.5 to 0.5; the drum comes up from below, and lifts it.
    preset.x_0 = {0, 0, -0.5};
    preset.pins.mode = Pins::Mode::list;
    preset.pins.list = {{0, 0}, {particles - 1, 0}};
    Body drum = body_of(Shape::cylinder, friction);
    drum.r = 0.2, drum.length = 0.2, drum.turn = {0, 0, 90}, drum.spin = {5, 0, 0};
    drum.path = {{0, {0, -0.25, 0}}, {0.5, {0, 0.1, 0}}};
    preset.bodies = {drum};
    Simulation simulation(preset);
    simulation.advance(int(6 / preset.dt));
    const State& state = simulation.read();
    const auto at = [&](int i) { return test::position(state, std::size_t(i)); };
    const auto tension = [&](int i) { return glm::distance(at(i), at(i + 1)) - preset.L; };
    // By so much the thread turns between its ends.
    const glm::dvec3 first = glm::normalize(at(2) - at(1)),
                     last = glm::normalize(at(particles - 2) - at(particles - 3));
    const double angle = std::acos(glm::dot(first, last));
    CHECK(angle > 1);
    const double ratio = tension(particles - 3) / tension(1);
    CHECK(std::max(ratio, 1 / ratio) / std::exp(friction * angle) == doctest::Approx(1).epsilon(0.0025));
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
