// Springs that lie across bodies: what comes through a cloth between its particles is found, and nothing else.
#include "core/analysis/pierced.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "tests/support/scenes.h"

namespace tyglab::pierced_test {

/// A flat cloth that nothing moves, in the plane y = 0 with its middle particle at the origin.
Preset flat(double L = 0.1) {
  Preset preset = test::quiet_cloth(9, 9);
  preset.L = L, preset.tilt_deg = 0, preset.x_0 = {0, 0, -4 * L};
  return preset;
}

Body body_of(Body::Shape shape, glm::dvec3 c) {
  Body body;
  body.shape = shape, body.c = c;
  return body;
}

Pierced of(const Preset& preset) {
  return pierced_springs(Simulation(preset));
}

TEST_CASE("a ball in the middle of a spring is found, wherever the spring runs, and one beside it is not") {
  Preset preset = flat();
  preset.bodies = {body_of(Body::Shape::sphere, {0.05, 0, 0})};
  preset.bodies[0].r = 0.02;
  CHECK(of(preset).springs == 1);
  CHECK(of(preset).body == 0);
  CHECK(pierced_in_words(Simulation(preset)) ==
        "The sphere comes through the cloth: one spring lies across it, since only particles meet bodies. Use a finer "
        "cloth (more rows and columns), or a body that is large beside L = 0.1 m.");
  // Where two diagonals cross.
  preset.bodies[0].c = {0.05, 0, 0.05};
  CHECK(of(preset).springs == 2);
  // By half its radius, no more.
  preset.bodies[0].c = {0.05, 0.0101, 0};
  CHECK(of(preset).springs == 0);
  preset.bodies[0].c = {0.05, 0.0099, 0};
  CHECK(of(preset).springs == 1);
  CHECK(pierced_in_words(Simulation(flat())).empty());
}

TEST_CASE("rods, plates and capsules between particles are found, planes never") {
  Preset preset = flat();
  Body rod = body_of(Body::Shape::cylinder, {0.05, 0, 0});
  rod.r = 0.01, rod.length = 2, rod.turn = {90, 0, 0};  // along z
  preset.bodies = {rod};
  // 9 springs along the rows, and 16 diagonals.
  CHECK(of(preset).springs == 25);
  preset.bodies[0].shape = Body::Shape::capsule;
  CHECK(of(preset).springs == 25);
  Body plate = body_of(Body::Shape::box, {0.05, 0, 0});
  plate.size = {0.02, 2, 2};
  preset.bodies = {body_of(Body::Shape::sphere, {9, 9, 9}), plate};
  CHECK(of(preset).springs == 25);
  CHECK(of(preset).body == 1);
  Body plane = body_of(Body::Shape::plane, {});
  plane.y = -1e-3;
  preset.bodies = {plane};
  CHECK(of(preset).springs == 0);
}

TEST_CASE("springs that are torn, pinned, or in a body with an end do not count") {
  Preset preset = flat();
  preset.bodies = {body_of(Body::Shape::sphere, {0.05, 0, 0})};
  preset.bodies[0].r = 0.02;
  preset.pins.mode = Pins::Mode::list, preset.pins.list = {{4, 5}};
  CHECK(of(preset).springs == 0);
  preset.pins.mode = Pins::Mode::none;
  Simulation cut(preset);
  cut.apply(edit::CutSprings{{{0, 4, 4}}});
  CHECK(pierced_springs(cut).springs == 0);
  // Its end is inside.
  preset.bodies[0].c = {0.1, 0, 0};
  CHECK(of(preset).springs == 0);
}

/// Springs across the body once that cloth has come down on it.
int after_fall(Preset preset, double seconds) {
  Simulation simulation(preset);
  int most = 0;
  for (int n = 0; n < 10; ++n) {
    simulation.advance(int(seconds / preset.dt / 10));
    most = std::max(most, pierced_springs(simulation).springs);
  }
  REQUIRE_FALSE(simulation.divergence());
  return most;
}

TEST_CASE("a cloth that drapes over a ball, a box or a rod is told apart from one that they come through") {
  Preset preset = test::cloth(25, 25);
  preset.L = 0.03, preset.tilt_deg = 0, preset.pins.mode = Pins::Mode::none, preset.dt = 5e-4;
  preset.x_0 = {0.007, 0.35, -0.36};
  preset.bodies = {body_of(Body::Shape::sphere, {0, 0, 0})};
  Body& body = preset.bodies[0];
  body.friction = 0.5, body.r = 0.3;
  CHECK(after_fall(preset, 1) == 0);
  // r = 2 L
  body.r = 0.06, body.c.y = 0.25;
  CHECK(after_fall(preset, 0.6) == 0);
  body = body_of(Body::Shape::box, {0, 0.1, 0});
  body.friction = 0.5, body.size = {0.4, 0.4, 0.3}, body.turn = {0, 30, 0};
  CHECK(after_fall(preset, 1) == 0);
  body = body_of(Body::Shape::cylinder, {0, 0.25, 0});
  body.friction = 0.5, body.r = 0.08, body.length = 1, body.turn = {0, 0, 90};
  CHECK(after_fall(preset, 1) == 0);
  // A rod of L/6 between two rows of particles: the cloth falls on as if it were not there.
  body.r = 0.005, body.c.z = 0.015;
  preset.x_0.y = 0.2525;
  CHECK(after_fall(preset, 0.01) == 24 * 3 + 1);
}

}  // namespace tyglab::pierced_test
