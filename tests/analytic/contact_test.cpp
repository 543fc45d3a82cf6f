// Contact within the step (kernels/contact.cl) against closed forms, and its order from both sides.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/model/words.h"
#include "tests/support/scenes.h"

namespace tyglab::contact_test {

constexpr double g = 9.82;

/// A particle that no spring pulls, at (0, 0); another hangs from the sky far above, out of the way.
Preset particle(const std::string& integrator, glm::dvec3 x, glm::dvec3 v) {
  Preset preset = test::quiet_cloth(2, 1, integrator);
  preset.k_s = 0, preset.g = g, preset.dt = 1e-3;
  preset.x_0 = x, preset.v_0 = v;
  preset.tilt_deg = -90;
  preset.L = 0.5;
  return preset;
}

Body plane(double friction, double restitution) {
  Body body;
  body.shape = Body::Shape::plane;
  body.friction = friction, body.restitution = restitution;
  return body;
}

Body ball(glm::dvec3 c, double r, double friction = 0, double restitution = 0) {
  Body body;
  body.c = c, body.r = r, body.friction = friction, body.restitution = restitution;
  return body;
}

glm::dvec3 x_of(Simulation& simulation) {
  return test::position(simulation.read(), 0);
}
glm::dvec3 v_of(Simulation& simulation) {
  return test::velocity(simulation.read(), 0);
}

/// Of fixed dt and at least second order: their free fall is exact.
const std::vector<std::string> second_order{"verlet",          "velocity_verlet",   "rk4",    "rkn4",
                                            "force_gradient4", "implicit_midpoint", "tr_bdf2"};

TEST_CASE("what a step makes of a constant acceleration is known for every method") {
  for (const Scheme& method : schemes()) {
    CAPTURE(method.name);
    const StepShape shape = step_shape(method);
    const auto is = [&](double position, double last_kick) {
      CHECK(shape.position == doctest::Approx(position));
      CHECK(shape.last_kick == doctest::Approx(last_kick));
    };
    const std::string name(method.name);
    if (name == "euler")
      is(0, 1);
    else if (name == "force_gradient4")
      is(2.0 / 3, 2.0 / 3);
    else if (method.order_undamped == 1 && name != "improved_euler")
      is(1, 1);
    else
      is(method.lag == 0.5 ? 1 : 0.5, 1);
  }
}

TEST_CASE("bounces end when their series does, and nothing hovers") {
  for (const Scheme& method : schemes()) {
    if (method.name == "euler") continue;
    for (const double e : {0.0, 0.3, 0.5, 0.8, 0.9}) {
      for (const double dt : {1e-3, 4e-3}) {
        CAPTURE(method.name);
        CAPTURE(e);
        constexpr double height = 0.3;
        Preset preset = particle(std::string(method.name), {0, height, 0}, {0, 0, 0});
        preset.dt = dt;
        preset.bodies = {plane(0, e)};
        const double rest = std::sqrt(2 * height / g) * (1 + e) / (1 - e);
        Simulation simulation(preset);
        simulation.advance(int(0.9 * rest / dt));
        const auto moves = [&] { return x_of(simulation).y != 0 || std::abs(v_of(simulation).y) > 1e-9; };
        if (e > 0) CHECK(moves());
        // The last bounces are shorter than a step; of a method of first order they are off by as much.
        simulation.advance(int(std::ceil((0.1 * rest + (1 + e) / (1 - e) * 8 * dt) / dt)));
        for (int look = 0; look < 20; ++look) {
          CHECK_FALSE(moves());
          simulation.advance(1);
        }
      }
    }
  }
}

TEST_CASE("friction stops a slide after v²/(2 μ g), and holds it there") {
  for (const std::string& method : second_order) {
    for (const double dt : {1e-3, 2.5e-4}) {
      CAPTURE(method);
      constexpr double speed = 1.3, friction = 0.4;
      Preset preset = particle(method, {0, 0, 0}, {speed * 0.6, 0, speed * 0.8});
      preset.dt = dt;
      preset.bodies = {plane(friction, 0.5)};
      Simulation simulation(preset);
      const double duration = speed / (friction * g), distance = speed * speed / (2 * friction * g);
      simulation.advance(int(0.5 * duration / dt));
      const double t = simulation.time();
      CHECK(glm::length(x_of(simulation)) == doctest::Approx(speed * t - friction * g * t * t / 2).epsilon(1e-9));
      CHECK(glm::length(v_of(simulation)) == doctest::Approx(speed - friction * g * t).epsilon(1e-9));
      simulation.advance(int(0.6 * duration / dt) + 1);
      CHECK(std::abs(glm::length(x_of(simulation)) - distance) < 0.2 * friction * g * dt * dt);
      const glm::dvec3 then = x_of(simulation);
      simulation.advance(500);
      CHECK(glm::length(x_of(simulation) - then) < 1e-12);
      CHECK(glm::length(v_of(simulation)) < 1e-12);
    }
  }
}

TEST_CASE("a particle slides off a smooth sphere at cos θ = 2/3, and sticks where friction holds it") {
  for (const std::string& method : second_order) {
    CAPTURE(method);
    constexpr double r = 0.3, from = 0.2;  // rad
    std::vector<double> errors;
    for (const double dt : {2e-3, 1e-3, 5e-4}) {
      Preset preset = particle(method, r * glm::dvec3(std::sin(from), std::cos(from), 0), {0, 0, 0});
      preset.dt = dt;
      preset.bodies = {ball({0, 0, 0}, r)};
      Simulation simulation(preset);
      // From energy: v² = 2 g r (cos θ_0 - cos θ), and it leaves at cos θ = 2/3 cos θ_0. Sliding, looked at before.
      while (x_of(simulation).y > 0.8 * r) simulation.advance(1);
      const glm::dvec3 x = x_of(simulation), v = v_of(simulation);
      CHECK(std::abs(glm::length(x) - r) < 1e-14);
      CHECK(std::abs(glm::dot(glm::normalize(v), x / r)) < 1e-4);
      errors.push_back(std::abs(glm::dot(v, v) / 2 + g * x.y - g * r * std::cos(from)));
      while (glm::length(x_of(simulation)) - r < 1e-12) simulation.advance(1);
      CHECK(x_of(simulation).y / r == doctest::Approx(2.0 / 3 * std::cos(from)).epsilon(0.01));
    }
    CAPTURE(errors[0]);
    CAPTURE(errors[2]);
    CHECK(errors[0] < 2e-4);
    CHECK(errors[2] < errors[0] / 10);  // order 2: 16 times less

    Preset rough = particle(method, r * glm::dvec3(std::sin(from), std::cos(from), 0), {0, 0, 0});
    rough.bodies = {ball({0, 0, 0}, r, 1.05 * std::tan(from))};
    Simulation sticks(rough);
    const glm::dvec3 start = x_of(sticks);
    sticks.advance(2000);
    CHECK(glm::length(x_of(sticks) - start) < 1e-9);
    rough.bodies[0].friction = 0.95 * std::tan(from);
    Simulation slides(rough);
    slides.advance(1000);
    CHECK(glm::length(x_of(slides) - start) > 0.01);
  }
}

TEST_CASE("nothing passes through a body between two steps") {
  for (const Scheme& method : schemes()) {
    for (const Precision precision : {Precision::double_, Precision::float_}) {
      CAPTURE(method.name);
      Preset preset = particle(std::string(method.name), {0.01, 3, 0.02}, {0, -1000, 0});
      preset.precision = precision;
      preset.dt = 0.01;
      preset.bodies = {ball({0, 0, 0}, 0.2)};
      Simulation simulation(preset);
      simulation.advance(1);
      const glm::dvec3 x = x_of(simulation);
      CHECK(glm::length(x) > 0.2 * (1 - 1e-6));
      CHECK(x.y > 0);
      preset.bodies[0].restitution = 1;
      Simulation elastic(preset);
      elastic.advance(1);
      CHECK(x_of(elastic).y > 1);
    }
  }
}

TEST_CASE("a particle that begins inside a body is outside after the step, and flies through where it is fast enough") {
  for (const Scheme& method : schemes()) {
    CAPTURE(method.name);
    for (const double speed : {0.0, 1.0, 1000.0}) {
      CAPTURE(speed);
      Preset preset = particle(std::string(method.name), {-0.1, 0, 0}, {speed, 0, 0});
      preset.bodies = {ball({0, 0, 0}, 0.2)};
      Simulation simulation(preset);
      simulation.advance(1);
      const glm::dvec3 x = x_of(simulation);
      CHECK(glm::length(x) > 0.2 * (1 - 1e-12));
      CHECK((speed > 100 ? std::abs(x.x - 0.9) < 1e-3 : x.x < -0.19));
    }
  }
}

TEST_CASE("between bodies no method gains energy by contact") {
  for (const std::string& method : {std::string("verlet"), std::string("rk4")}) {
    test::Random random(7);
    for (int scene = 0; scene < 40; ++scene) {
      CAPTURE(scene);
      Preset preset = particle(method, {random.uniform(-0.3, 0.3), 0.6, random.uniform(-0.3, 0.3)},
                               {random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)});
      preset.dt = random.uniform(2e-4, 8e-3);
      preset.bodies = {plane(random.uniform(0, 1), random.uniform(0.5, 1)),
                       ball({0, 0.1, 0}, 0.25, random.uniform(0, 1), random.uniform(0.5, 1)),
                       ball({0.5, 0.3, 0}, 0.2, random.uniform(0, 1), random.uniform(0.5, 1))};
      Simulation simulation(preset);
      const auto energy = [&] { return glm::dot(v_of(simulation), v_of(simulation)) / 2 + g * x_of(simulation).y; };
      double before = energy();
      for (int step = 0; step < 1500; ++step) {
        simulation.advance(1);
        const double now = energy();
        CHECK(now <= before + 1e-3 * g * preset.dt);
        before = now;
      }
    }
  }
}

/// The slope of log(error) over log(dt), from many dt: an error depends on where in a step the impacts fall.
/// Without damping, by which the neighbors of a particle feel an impact's change of velocity for the rest of the step.
double order_of(const std::string& method, const std::string& contact) {
  Preset preset = test::cloth(3, 3, method);
  preset.pins.mode = Pins::Mode::none;
  preset.k_b = 0, preset.k_d = 0, preset.k_s = 20, preset.m = 0.01, preset.L = 0.1;
  preset.x_0 = {0.02, 0.2, 0.01}, preset.tilt_deg = 40, preset.v_0 = {0.7, -0.5, 0.3}, preset.initial_stretch = 1.2;
  preset.bodies = {plane(0.3, 0.4), ball({0.1, -0.05, 0.05}, 0.15, 0.2, 0.6)};
  preset.contact = contact;
  constexpr double end = 0.25;
  const auto final_state = [&](const std::string& integrator, int steps) {
    Preset one = preset;
    one.integrator = integrator, one.dt = end / steps;
    Simulation simulation(one);
    simulation.advance(steps);
    return simulation.read();
  };
  const State exact = final_state("rk4", 160'000);
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  int count = 0;
  for (double steps = 150; steps < 3000; steps *= 1.15) {
    const int n = int(steps);
    const State state = final_state(method, n);
    double error = 0;
    for (std::size_t p = 0; p < 9; ++p)
      error = std::max(error, glm::distance(test::position(state, p), test::position(exact, p)));
    const double x = std::log(end / n), y = std::log(error);
    sx += x, sy += y, sxx += x * x, sxy += x * y, ++count;
  }
  return (count * sxy - sx * sy) / (count * sxx - sx * sx);
}

TEST_CASE(
    "through bounces and slides methods keep order 2, and have order 1 where contact waits for the end of the step" *
    doctest::test_suite("slow")) {
  for (const std::string& method : second_order) {
    const double local = order_of(method, "local"), at_end = order_of(method, "step");
    CAPTURE(method);
    CAPTURE(local);
    CAPTURE(at_end);
    CHECK(local > 1.8);
    CHECK(local < 2.3);
    CHECK(at_end > 0.7);
    CHECK(at_end < 1.4);
  }
}

/// A mass on an undamped spring that bounces off a plane: between impacts its motion is a sine.
struct Bouncing {
  double omega, middle, amplitude, floor, e;
  /// Height above the middle, and velocity, at time t after it was let go at `amplitude`.
  glm::dvec2 at(double t) const {
    double a = amplitude, phase = 0;  // y = a cos(ω t + phase), of the present flight
    for (;;) {
      const double meets = (std::acos((floor - middle) / a) - phase) / omega;
      if (t < meets) return {middle + a * std::cos(omega * t + phase), -a * omega * std::sin(omega * t + phase)};
      t -= meets;
      const double y = floor - middle, v = e * a * omega * std::sin(omega * meets + phase);
      a = std::hypot(y, v / omega), phase = std::atan2(-v / omega, y);
    }
  }
};

Preset bouncing_weight(const std::string& method, const std::string& contact, Bouncing& exact) {
  Preset preset = test::one_weight(method);
  preset.precision = Precision::double_, preset.contact = contact;
  preset.k = 20, preset.m = 0.5, preset.k_d = 0, preset.L = 0.5, preset.offset = 0.3, preset.g = g;
  preset.v_0 = {0, 0, 0}, preset.tolerance = 1e-9;
  exact.omega = std::sqrt(preset.k / preset.m), exact.middle = preset.x_0.y - preset.m * g / preset.k;
  exact.amplitude = preset.x_0.y + preset.offset - exact.middle, exact.e = 0.8;
  exact.floor = exact.middle - 0.3;
  Body floor = plane(0, exact.e);
  floor.y = exact.floor;
  preset.bodies = {floor};
  return preset;
}

TEST_CASE("a mass on a spring that bounces: the method's own order where steps are split, 2 where they are not") {
  const auto error = [](const std::string& method, const std::string& contact, double dt) {
    Bouncing exact{};
    Preset preset = bouncing_weight(method, contact, exact);
    preset.dt = dt;
    Simulation simulation(preset);
    double worst = 0;
    for (int n = 0; n < 10; ++n) {
      simulation.advance(int(std::lround(0.31 / dt)));
      const glm::dvec2 should = exact.at(simulation.time());
      worst = std::max(worst, std::abs(x_of(simulation).y - should.x));
    }
    return worst;
  };
  // Where in its step an impact falls decides over the error too: a line through many.
  const auto order = [&](const std::string& method, const std::string& contact) {
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (double dt = 0.01; dt > 0.0025; dt *= 0.93) {
      const double x = std::log(dt), y = std::log(error(method, contact, dt));
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
  };
  for (const auto& [method, own] : std::vector<std::pair<std::string, double>>{{"rk4", 4},
                                                                               {"velocity_verlet", 2},
                                                                               {"verlet", 2},
                                                                               {"rkn4", 4},
                                                                               {"force_gradient4", 4},
                                                                               {"implicit_midpoint", 2}}) {
    CAPTURE(method);
    const double measured = order(method, "global");
    CHECK(measured > own - 0.3);
    CHECK(measured < own + 0.3);
    if (own > 2) {
      CHECK(order(method, "local") > 1.9);
      CHECK(order(method, "step") < 1.7);
      CHECK(error(method, "global", 0.0025) < 1e-3 * error(method, "local", 0.0025));
    }
  }
  CHECK(error("dopri5", "global", 0.01) < 2e-8);
}

TEST_CASE("a mass on a spring comes to rest on what stands in its way") {
  for (const Scheme& method : schemes())
    for (const std::string_view contact : contact_names) {
      CAPTURE(method.name);
      CAPTURE(contact);
      Bouncing exact{};
      Preset preset = bouncing_weight(std::string(method.name), std::string(contact), exact);
      preset.bodies[0].restitution = 0.3, preset.bodies[0].y = exact.middle + 0.05;
      preset.dt = 1e-3;
      Simulation simulation(preset);
      simulation.advance(3000);
      CHECK(std::abs(x_of(simulation).y - preset.bodies[0].y) < 1e-5);
      CHECK(simulation.particle(0, 0).on_body);
    }
}

TEST_CASE("split steps: a cloth comes down as with local contact, and energy is accounted for") {
  Preset preset = test::quiet_cloth(6, 6);
  preset.precision = Precision::double_, preset.tilt_deg = 20, preset.pins.mode = Pins::Mode::none, preset.k_d = 0;
  preset.g = g, preset.dt = 5e-4;
  preset.bodies = {plane(0.3, 0.5), ball({0, 0.1, 0.1}, 0.1, 0.2, 0.3)};
  preset.x_0 = {0, 0.35, 0};
  const auto after = [&](const char* contact, double dt, int steps) {
    Preset own = preset;
    own.contact = contact, own.dt = dt;
    auto simulation = std::make_unique<Simulation>(own);
    simulation->enable_ledger(true);
    simulation->advance(steps);
    return simulation;
  };
  const auto fine = after("local", 2.5e-5, 8000), split = after("global", 5e-4, 400), local = after("local", 5e-4, 400);
  CHECK(split->time() == doctest::Approx(0.2));
  double of_split = 0, of_local = 0;
  for (std::size_t p = 0; p < 36; ++p) {
    of_split = std::max(of_split, glm::distance(test::position(split->read(), p), test::position(fine->read(), p)));
    of_local = std::max(of_local, glm::distance(test::position(local->read(), p), test::position(fine->read(), p)));
  }
  CHECK(of_local < 1e-3);
  CHECK(of_split < of_local);
  CHECK(std::abs(split->ledger()->share()) < 3e-3);
  CHECK(split->ledger()->works.contact < 0);
}

}  // namespace tyglab::contact_test
