// Methods that make a fixed number of passes over implicit Euler's equations: their step against implicit Euler's own,
// which Newton's method finds.
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "core/cloth/lattice.h"
#include "core/integrators/scheme.h"
#include "core/simulation.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::passes_test {

std::vector<std::string> methods() {
  std::vector<std::string> names;
  for (const Scheme& method : schemes())
    if (counts_passes(method)) names.emplace_back(method.name);
  return names;
}

/// Positions and velocities after one step from a cloth that is folded, taut and slack in places, in which also
/// springs are cut.
State after_step(Preset preset, const std::string& method, int iterations, double amount) {
  preset.integrator = method, preset.iterations = iterations;
  Simulation simulation(preset);
  test::load(simulation, test::crumpled(preset, 7, amount));
  if (preset.rows > 6) simulation.apply(edit::Cut{{{3, 2}, {4, 3}}});
  simulation.advance(1);
  return simulation.read();
}

/// The largest difference of positions, in parts of the way that a particle makes in the step.
double error(const Preset& preset, const std::string& method, int iterations, double amount) {
  const State start = test::crumpled(preset, 7, amount);
  const State wanted = after_step(preset, "implicit_euler", 1000, amount);
  const State found = after_step(preset, method, iterations, amount);
  double most = 0, way = 0;
  for (std::size_t p = 0; p < wanted.x.x.size(); ++p) {
    most = std::max(most, glm::length(test::position(found, p) - test::position(wanted, p)));
    way = std::max(way, glm::length(test::position(wanted, p) - test::position(start, p)));
  }
  return most / way;
}

void check_fall(const Preset& preset, double amount) {
  for (const std::string& method : methods()) {
    CAPTURE(method);
    CAPTURE(preset.W.z);
    CAPTURE(preset.k_d);
    double before = error(preset, method, 1, amount);
    CHECK(before > 1e-4);
    for (const int iterations : {2, 4, 8, 16, 32, 64}) {
      CAPTURE(iterations);
      const double now = error(preset, method, iterations, amount);
      CHECK((now < before || now < 1e-9));
      before = now;
    }
    CHECK(error(preset, method, 1000, amount) < 1e-6);
  }
}

TEST_CASE("with more passes a step comes ever nearer to implicit Euler's, and to a millionth of it") {
  Preset preset = test::cloth(9, 8);
  preset.dt = 4e-3, preset.k_b = 3;
  preset.pins.mode = Pins::Mode::top_corners;
  check_fall(preset, 0.3);
  // So short a step that projective dynamics needs few products with its matrix, and makes them.
  preset.dt = 1e-3;
  check_fall(preset, 0.3);
  preset.dt = 4e-3;
  preset.k_d = 0.05, preset.W = {0.001, 0, 0.004};
  check_fall(preset, 0.3);
  // Taut, without bending, and so stiff that one pass is far from enough.
  preset.initial_stretch = 1.3, preset.k_s = 500, preset.k_b = 0, preset.k_d = 0;
  preset.pins.mode = Pins::Mode::boundary;
  check_fall(preset, 0.1);
}

/// What implicit Euler's step minimizes (docs/model.md), at positions `x`, for a cloth that was at `c` with the
/// velocities of that state and is whole.
double minimized(const Preset& p, const State& c, const State& x) {
  const auto at = [&](const State& state, int i, int j) {
    return test::position(state, std::size_t(i) * std::size_t(p.columns) + std::size_t(j));
  };
  double sum = 0;
  for (int i = 0; i < p.rows; ++i)
    for (int j = 0; j < p.columns; ++j) {
      const std::size_t n = std::size_t(i) * std::size_t(p.columns) + std::size_t(j);
      const glm::dvec3 y = test::position(c, n) + p.dt * test::velocity(c, n) - glm::dvec3(0, p.dt * p.dt * p.g, 0);
      const double off = glm::length(test::position(x, n) - y) / p.dt;
      sum += 0.5 * p.m * off * off;
      for (int d = 0; d < int(directions.size()); ++d) {
        const Direction& to = directions[std::size_t(d)];
        if (!Lattice{p.rows, p.columns}.has_spring(d, i, j)) continue;
        const glm::dvec3 now = at(x, i + to.di, j + to.dj) - at(x, i, j);
        const glm::dvec3 then = at(c, i + to.di, j + to.dj) - at(c, i, j);
        const double longer = glm::length(now) - to.rest * p.L, turned = glm::length(now - then);
        if (to.bending)
          sum += longer < 0 ? 0.5 * p.k_b * longer * longer : 0;
        else
          sum += (longer > 0 ? 0.5 * p.k_s * longer * longer : 0) + 0.5 * p.k_d / p.dt * turned * turned;
      }
    }
  return sum;
}

TEST_CASE("what nothing holds falls freely, in one pass and however stiff it is; what hangs at rest stays") {
  for (const std::string& method : methods()) {
    CAPTURE(method);
    Preset preset = test::cloth(24, 20, method);
    preset.pins.mode = Pins::Mode::none, preset.tilt_deg = 0;
    preset.k_s = 1e5, preset.dt = 1.0 / 60, preset.iterations = 1;
    Simulation simulation(preset);
    const State start = simulation.read();
    simulation.advance(2);
    // Implicit Euler falls by 1 and then by 2 times g dt².
    CHECK(test::position(start, 210).y - test::position(simulation.read(), 210).y ==
          doctest::Approx(3 * preset.g * preset.dt * preset.dt).epsilon(1e-6));
  }
  Preset hanging = test::cloth(8, 6, "implicit_euler");
  hanging.pins.mode = Pins::Mode::top_row, hanging.tilt_deg = 90, hanging.k_d = 0.02, hanging.dt = 0.05;
  hanging.iterations = 100;
  Simulation rests(hanging);
  rests.advance(4000);
  hanging.integrator = "vbd", hanging.iterations = 1;
  Simulation simulation(hanging);
  const State start = rests.read();
  test::load(simulation, start);
  simulation.advance(1);
  for (std::size_t p = 0; p < start.x.x.size(); ++p)
    CHECK(glm::length(test::position(simulation.read(), p) - test::position(start, p)) < 1e-6);
}

TEST_CASE("a piece that is cut off falls, and the rest hangs") {
  Preset preset = test::cloth(16, 12, "vbd");
  preset.pins.mode = Pins::Mode::top_row, preset.tilt_deg = 90;
  preset.k_s = 1e5, preset.dt = 1.0 / 60, preset.iterations = 1;
  Simulation simulation(preset);
  const State start = simulation.read();
  edit::CutSprings cut;
  for (int d = 1; d < stretch_directions; ++d)
    for (int j = 0; j < preset.columns; ++j)
      if (Lattice{preset.rows, preset.columns}.has_spring(d, 8, j)) cut.springs.push_back({d, 8, j});
  simulation.apply(cut);
  simulation.advance(1);
  const State after = simulation.read();
  const double fall = preset.g * preset.dt * preset.dt;
  CHECK(test::position(start, 15 * 12 + 5).y - test::position(after, 15 * 12 + 5).y ==
        doctest::Approx(fall).epsilon(1e-6));
  CHECK(test::position(start, 4 * 12 + 5).y - test::position(after, 4 * 12 + 5).y < 0.5 * fall);
}

TEST_CASE("stiff steps that few passes have not solved are reported in float too") {
  for (const char* integrator : {"projective_dynamics", "vbd"}) {
    CAPTURE(std::string(integrator));
    Preset preset = test::cloth(16, 16, integrator);
    preset.L = 0.06, preset.tilt_deg = 30, preset.k_s = 1e6, preset.dt = 0.02;
    preset.precision = Precision::float_;
    Simulation simulation(preset);
    simulation.advance(10);
    CHECK(simulation.engine().solves().worst_residual > 0.01);
    CHECK(simulation.engine().solves().unconverged == 10);
  }
}

TEST_CASE("no pass raises what implicit Euler's step minimizes, however stiff and crumpled the cloth") {
  for (const std::string& method : methods())
    for (const double k_s : {50.0, 1e3, 1e5, 1e8})
      for (const double k_b : {0.0, 10.0, 1e5})
        for (const double k_d : {0.0, 0.1}) {
          CAPTURE(method);
          CAPTURE(k_s);
          CAPTURE(k_b);
          CAPTURE(k_d);
          Preset preset = test::cloth(7, 8, method);
          preset.pins.mode = Pins::Mode::none;
          preset.k_s = k_s, preset.k_b = k_b, preset.k_d = k_d, preset.dt = 1.0 / 60;
          const State start = test::crumpled(preset, 3);
          double before = std::numeric_limits<double>::infinity();
          for (const int iterations : {1, 2, 3, 4, 5, 6, 8, 10, 15, 20}) {
            CAPTURE(iterations);
            preset.iterations = iterations;
            Simulation simulation(preset);
            test::load(simulation, start);
            simulation.advance(1);
            const double now = minimized(preset, start, simulation.read());
            CHECK(now <= before * (1 + 1e-9));
            before = now;
          }
        }
}

TEST_CASE("a mass on a spring takes implicit Euler's step, however few the passes") {
  for (const std::string& method : methods()) {
    CAPTURE(method);
    Preset preset = test::one_weight(method);
    preset.k_d = 0.1, preset.iterations = 1;
    Preset other = preset;
    other.integrator = "implicit_euler";
    Simulation a(preset), b(other);
    a.advance(200), b.advance(200);
    CHECK(a.read().x.y[0] == doctest::Approx(b.read().x.y[0]).epsilon(1e-9));
    CHECK(a.engine().solves().unconverged == 0);
  }
}

TEST_CASE("few passes stay bounded at any dt, stiffness and damping" * doctest::test_suite("slow")) {
  for (const std::string& method : methods())
    for (const double k_s : {1e3, 1e9})
      for (const double dt : {1e-3, 1.0 / 30, 1.0})
        for (const double k_d : {0.0, 1e4})
          for (const Precision precision : {Precision::float_, Precision::double_}) {
            CAPTURE(method);
            CAPTURE(k_s);
            CAPTURE(dt);
            CAPTURE(k_d);
            Preset preset = test::cloth(10, 10, method);
            preset.k_s = k_s, preset.k_d = k_d, preset.dt = dt, preset.precision = precision, preset.iterations = 3;
            Simulation simulation(preset);
            simulation.advance(test::fewer(400, 40));
            CHECK_FALSE(simulation.divergence().has_value());
          }
}

TEST_CASE("steps that their passes leave unsolved are counted, and none that they solve") {
  for (const std::string& method : methods()) {
    CAPTURE(method);
    Preset preset = test::cloth(8, 8, method);
    preset.dt = 1.0 / 60, preset.k_s = 1e4, preset.iterations = 2;
    Simulation short_of_it(preset);
    short_of_it.advance(5);
    CHECK(short_of_it.engine().solves().unconverged == 5);
    CHECK(short_of_it.engine().solves().newton == 10);
    CHECK(short_of_it.engine().solves().worst_residual > 1e-6);
    preset.dt = 2e-4, preset.k_s = 50, preset.iterations = 60;
    Simulation solved(preset);
    solved.advance(5);
    CHECK(solved.engine().solves().unconverged == 0);
    CHECK(solved.engine().solves().worst_residual <= 1e-6);
  }
}

TEST_CASE("tearing and the hand mean the same newtons as with other methods") {
  for (const std::string& method : methods()) {
    CAPTURE(method);
    // Two weights under each other: the spring holds the lower one.
    Preset preset = test::cloth(2, 1, method);
    preset.tilt_deg = 90, preset.k_b = 0, preset.k_d = 0.05, preset.dt = 1e-3;
    preset.pins.mode = Pins::Mode::list;
    Simulation simulation(preset);
    simulation.apply(edit::Grab{0, 0});
    simulation.advance(2000);
    const double weight = preset.m * preset.g;
    CHECK(simulation.hand_force().y == doctest::Approx(-2 * weight).epsilon(1e-4));
    CHECK(simulation.particle(1, 0)["F_s"].y == doctest::Approx(weight).epsilon(1e-4));
  }
}

TEST_CASE("a pinned row holds, and a cut parts, while steps go on") {
  for (const std::string method : {"projective_dynamics", "vbd", "xpbd"}) {
    CAPTURE(method);
    Preset preset = test::cloth(6, 19, method);
    preset.pins.mode = Pins::Mode::top_row;
    preset.dt = 1e-3;
    Simulation simulation(preset);
    const State start = simulation.read();
    simulation.advance(20);
    edit::Cut cut;
    for (int j = 0; j < 19; ++j) cut.sites.push_back({3, j});
    simulation.apply(cut);
    simulation.advance(500);
    const State& state = simulation.read();
    for (std::size_t j = 0; j < 19; ++j) {
      CHECK(test::position(state, j) == test::position(start, j));
      CHECK(state.x.y[5 * 19 + j] - start.x.y[5 * 19 + j] < -0.9);  // free fall: 1.2 m
      CHECK(state.x.y[2 * 19 + j] - start.x.y[2 * 19 + j] > -0.1);
    }
  }
}

}  // namespace tyglab::passes_test
