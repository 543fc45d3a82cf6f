// The core against the oracle: the same scene, 200 steps, 1e-10 m. Euler and improved Euler run at dt = 1e-4, since at
// 1e-3 they amplify rounding itself.
#include <doctest/doctest.h>

#include <functional>
#include <glm/geometric.hpp>
#include <utility>

#include "core/io/preset_io.h"
#include "core/model/words.h"
#include "tests/oracle/oracle.h"
#include "tests/support/scenes.h"

namespace tyglab::agreement_test {

struct Scene {
  const char* name;
  int rows, columns;
  std::function<void(Preset&)> change;
};

Body sphere(glm::dvec3 c, double r, double friction, double restitution) {
  Body body;
  body.c = c;
  body.r = r;
  body.friction = friction;
  body.restitution = restitution;
  return body;
}

Body plane(double y, double friction, double restitution) {
  Body body;
  body.shape = Body::Shape::plane;
  body.y = y;
  body.friction = friction;
  body.restitution = restitution;
  return body;
}

std::vector<Scene> motion_scenes() {
  return {
      {"hanging", 16, 16, [](Preset&) {}},
      {"odd size", 17, 23, [](Preset&) {}},
      {"small", 7, 5, [](Preset&) {}},
      {"smallest", 2, 1,
       [](Preset& p) {
         p.v_0 = {0.3, 0, 0.1};
       }},
      {"thread of three", 3, 1,
       [](Preset& p) {
         p.v_0 = {0.3, 0, 0.1};
       }},
      {"one quad", 2, 2,
       [](Preset& p) {
         p.W = {0, 0, 1e-3};
       }},
      {"two rows", 2, 9,
       [](Preset& p) {
         p.W = {0, 0, 1e-3};
       }},
      {"wind", 7, 5,
       [](Preset& p) {
         p.W = {1e-3, -2e-4, 5e-3};
       }},
      {"wind on an even size", 8, 8,
       [](Preset& p) {
         p.W = {0, 4e-4, 5e-3}, p.pins.mode = Pins::Mode::left_column;
       }},
      {"air, wind and gravity", 7, 6,
       [](Preset& p) {
         p.air_density = 1.2, p.C_N = 1.2, p.C_T = 0.1, p.u = {3, 1, -4}, p.W = {0, 0, 1e-3};
       }},
      {"falling through still air", 5, 9,
       [](Preset& p) {
         p.air_density = 1.2, p.C_T = 0.3, p.v_0 = {1, -2, 0.5}, p.pins.mode = Pins::Mode::none;
       }},
      {"warp, weft and diagonals of their own", 9, 8,
       [](Preset& p) { p.k_warp = 90, p.k_weft = 30, p.k_shear = 4, p.initial_stretch = 1.05; }},
      {"no diagonals", 6, 9, [](Preset& p) { p.k_shear = 0; }},
      {"taut", 9, 8, [](Preset& p) { p.initial_stretch = 1.1; }},
      {"slack", 9, 8, [](Preset& p) { p.initial_stretch = 0.8; }},
      {"undamped", 9, 8, [](Preset& p) { p.k_d = 0; }},
      {"without bending", 9, 8, [](Preset& p) { p.k_b = 0, p.initial_stretch = 0.9; }},
      {"no gravity, moving", 6, 6,
       [](Preset& p) {
         p.g = 0, p.v_0 = {0.2, -0.4, 0.7};
       }},
      {"upward gravity", 6, 6, [](Preset& p) { p.g = -3; }},
      {"vertical", 6, 7, [](Preset& p) { p.tilt_deg = 90; }},
      // Arrays go on behind the last column, with zeros: they must not act as particles at the origin.
      {"folded round the origin", 7, 9,
       [](Preset& p) {
         p.x_0 = {0, 0.05, 0}, p.initial_stretch = 0.4, p.pins.mode = Pins::Mode::none, p.g = 0;
       }},
      {"tilted over", 6, 7, [](Preset& p) { p.tilt_deg = -130; }},
  };
}

std::vector<Scene> pin_scenes() {
  std::vector<Scene> scenes;
  using enum Pins::Mode;
  for (const auto mode : {none, top_row, top_corners, four_corners, left_column, boundary}) {
    scenes.push_back({name_of(mode).data(), 7, 6, [mode](Preset& p) {
                        p.pins.mode = mode;
                        p.tilt_deg = 40;
                        p.W = {0, 0, 3e-3};
                      }});
  }
  scenes.push_back({"a list", 7, 6, [](Preset& p) {
                      p.pins.mode = list;
                      p.pins.list = {{3, 2}, {0, 5}, {6, 0}};
                    }});
  scenes.push_back({"a list of none", 4, 4, [](Preset& p) { p.pins.mode = list; }});
  return scenes;
}

std::vector<Scene> body_scenes() {
  const auto flat = [](Preset& p, double height) {
    p.pins.mode = Pins::Mode::none;
    p.tilt_deg = 0;
    p.x_0 = {0.01, height, -0.07};
    p.v_0 = {0.1, -1, 0.05};
  };
  return {
      {"on a sphere", 9, 8,
       [=](Preset& p) {
         flat(p, 0.26), p.bodies = {sphere({0, 0.1, 0}, 0.1, 0, 0)};
       }},
      {"sphere, friction and restitution", 9, 8,
       [=](Preset& p) {
         flat(p, 0.26), p.bodies = {sphere({0, 0.1, 0}, 0.1, 0.4, 0.3)};
       }},
      {"on a plane", 9, 8, [=](Preset& p) { flat(p, 0.05), p.bodies = {plane(0, 0, 0)}; }},
      {"plane, friction", 9, 8, [=](Preset& p) { flat(p, 0.05), p.bodies = {plane(0, 0.6, 0)}; }},
      {"plane, restitution", 9, 8, [=](Preset& p) { flat(p, 0.05), p.bodies = {plane(0, 0.2, 0.7)}; }},
      {"sphere and plane", 9, 8,
       [=](Preset& p) {
         flat(p, 0.2), p.bodies = {sphere({0, 0.05, 0}, 0.1, 0.3, 0), plane(0, 0.5, 0)};
       }},
      {"swinging against a sphere", 9, 8,
       [](Preset& p) {
         p.tilt_deg = 30;
         p.x_0 = {0, 0.4, 0};
         p.bodies = {sphere({0, 0.25, 0.1}, 0.08, 0.2, 0.1)};
       }},
  };
}

void compare(const Scene& scene, const std::string& integrator) {
  CAPTURE(std::string(scene.name));
  CAPTURE(std::string(integrator));
  Preset preset = test::cloth(scene.rows, scene.columns, integrator);
  preset.contact = "step";  // the oracle's rule
  scene.change(preset);
  REQUIRE(check_preset(preset) == "");
  Simulation simulation(preset);
  oracle::Cloth cloth(preset);
  CHECK(test::distance(simulation, cloth) < 1e-15);
  simulation.advance(200);
  cloth.advance(200);
  CHECK(simulation.steps() == 200);
  CHECK(test::distance(simulation, cloth) < 1e-10);
  CHECK(test::velocity_distance(simulation, cloth) < 1e-7);
  // The scene must have moved, or it would test nothing.
  Simulation start(preset);
  if (preset.pins.mode != Pins::Mode::boundary) CHECK(test::distance(start, cloth) > 1e-5);
}

TEST_CASE("motion agrees with the oracle to 1e-10 m after 200 steps") {
  for (const auto& scene : motion_scenes()) {
    for (const char* integrator : {"verlet", "euler", "improved_euler"}) compare(scene, integrator);
  }
}

TEST_CASE("pins of every kind agree with the oracle") {
  for (const auto& scene : pin_scenes()) {
    for (const char* integrator : {"verlet", "euler", "improved_euler"}) compare(scene, integrator);
  }
}

TEST_CASE("collisions agree with the oracle") {
  for (auto scene : body_scenes()) {
    compare(scene, "verlet");
    // Ten times shorter steps: start nearer and faster, so that the cloth strikes within 200 of them.
    const auto change = scene.change;
    scene.change = [change](Preset& p) {
      change(p);
      p.x_0.y -= 0.04;
      p.v_0 *= 3.0;
    };
    for (const char* integrator : {"euler", "improved_euler"}) compare(scene, integrator);
  }
}

TEST_CASE("a crumpled start agrees with the oracle: every spring pulls, pushes or is slack") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    for (const auto& [rows, columns] : {std::pair{2, 1}, {3, 1}, {2, 2}, {7, 5}, {17, 23}}) {
      CAPTURE(std::string(integrator));
      CAPTURE(rows);
      Preset preset = test::cloth(rows, columns, integrator);
      preset.W = {2e-3, 1e-3, -4e-3};
      preset.pins.mode = Pins::Mode::top_row;
      // Without damping and at a tenth of the usual stiffness, so that the motion stays tame.
      preset.k_s = 5;
      const State state = test::crumpled(preset, 7);
      Simulation simulation(preset);
      oracle::Cloth cloth(preset);
      test::load(simulation, state);
      test::load(cloth, state);
      simulation.advance(200);
      cloth.advance(200);
      CHECK(test::distance(simulation, cloth) < 1e-10);
    }
  }
}

TEST_CASE("tearing agrees with the oracle, spring for spring") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    CAPTURE(std::string(integrator));
    Preset preset = test::cloth(12, 11, integrator);
    preset.W = {0, 0, 0.02};
    preset.initial_stretch = 1.02;
    preset.F_max = 0.1;
    preset.k_b = 3;
    preset.k_weft = 70, preset.k_shear = 35;
    const State state = test::crumpled(preset, 3, 0.15, 0.5);
    Simulation simulation(preset);
    oracle::Cloth cloth(preset);
    test::load(simulation, state);
    test::load(cloth, state);
    int torn = 0;
    for (int step = 0; step < 200; ++step) {
      torn += simulation.advance(1).torn;
      cloth.step();
    }
    CHECK(test::distance(simulation, cloth) < 1e-10);
    int torn_in_oracle = 0;
    for (int direction = 0; direction < stretch_directions; ++direction) {
      for (int i = 0; i < preset.rows; ++i) {
        for (int j = 0; j < preset.columns; ++j) {
          if (!simulation.lattice().has_spring(direction, i, j)) continue;
          const Direction& d = directions[direction];
          const bool whole = cloth.whole(i, j, i + d.di, j + d.dj);
          CHECK(simulation.tears().whole(direction, i, j) == whole);
          torn_in_oracle += whole ? 0 : 1;
        }
      }
    }
    CHECK(torn == torn_in_oracle);
    CHECK(torn > 20);
    CHECK(torn < 300);
    CHECK(simulation.tears().torn_count() == torn);
  }
}

TEST_CASE("the hand and the knife agree with the oracle") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    CAPTURE(std::string(integrator));
    const Preset preset = test::cloth(9, 8, integrator);
    Simulation simulation(preset);
    oracle::Cloth cloth(preset);
    const auto advance = [&](int steps) {
      simulation.advance(steps);
      cloth.advance(steps);
      CHECK(test::distance(simulation, cloth) < 1e-10);
    };
    advance(40);
    simulation.apply(edit::Grab{5, 3});
    cloth.grab(5, 3);
    advance(20);
    const glm::dvec3 to = cloth.at(5, 3).x + glm::dvec3(0.01, 0.02, 0.03);
    simulation.apply(edit::MoveHand{to, 50});
    cloth.move_hand(to, 50);
    advance(50);
    CHECK(glm::length(cloth.at(5, 3).x - to) < 1e-12);
    advance(20);
    simulation.apply(edit::Cut{{{4, 4}, {4, 0}}});
    cloth.cut(4, 4);
    cloth.cut(4, 0);
    advance(20);
    simulation.apply(edit::Release{});
    cloth.release();
    advance(50);
  }
}

TEST_CASE("a change of dt while running agrees with the oracle") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    CAPTURE(std::string(integrator));
    Preset preset = test::cloth(7, 5, integrator);
    preset.W = {0, 0, 2e-3};
    Simulation simulation(preset);
    oracle::Cloth cloth(preset);
    for (const double factor : {1.0, 0.5, 0.3, 1.2}) {
      Preset changed = preset;
      changed.dt = preset.dt * factor;
      simulation.apply(edit::Change{changed});
      cloth.set_dt(changed.dt);
      simulation.advance(50);
      cloth.advance(50);
      CHECK(test::distance(simulation, cloth) < 1e-10);
    }
  }
}

TEST_CASE("several threads agree with the oracle") {
  Preset preset = test::cloth(71, 69, "verlet");
  preset.L = 0.01;
  preset.W = {0, 1e-4, 1e-3};
  preset.bodies = {sphere({0, 0.7, 0.05}, 0.1, 0.2, 0)};
  preset.contact = "step";
  Simulation simulation(preset, 3);
  CHECK(simulation.engine().threads() == 3);
  oracle::Cloth cloth(preset);
  simulation.advance(150);
  cloth.advance(150);
  CHECK(test::distance(simulation, cloth) < 1e-10);
}

TEST_CASE("float follows double: 200 steps of the default cloth within 2e-5 m") {
  // 200 steps of free fall travel 0.2 m; float resolves 6e-8 of a meter at this distance from the origin, and each step
  // rounds a position once.
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    CAPTURE(std::string(integrator));
    Preset preset = test::cloth(16, 16, integrator);
    preset.W = {0, 0, 1e-3};
    preset.precision = Precision::float_;
    Simulation simulation(preset);
    oracle::Cloth cloth(preset);
    simulation.advance(200);
    cloth.advance(200);
    CHECK(test::distance(simulation, cloth) < 2e-5);
    CHECK(test::distance(simulation, cloth) > 0);
  }
}

}  // namespace tyglab::agreement_test
