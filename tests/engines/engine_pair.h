// The same scene on the CPU engine and on OpenCL, with the same edits: states equal within rounding.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <string>

#include "core/integrators/scheme.h"
#include "core/simulation.h"
#include "tests/support/scenes.h"

namespace tyglab::test {

/// How far the engines may be apart after a hundred steps or so, m: rounding, and of methods that solve what the solver
/// leaves. Newton's method ends where the residual is 1e-10 of its start (float: 1e-5), which is dt |a| over all
/// particles: for some thousand of them at rest, dt = 1e-3 s, about 0.4 m/s. A step errs by that at most, since nothing
/// makes A less than 1, and n steps thus by n²/2 dt times that.
inline double tolerance(const Preset& preset) {
  const bool single = preset.precision == Precision::float_;
  if (is_implicit(scheme(preset.integrator))) return single ? 1e-4 : 1e-9;
  return single ? 2e-5 : 1e-11;
}

inline double distance(const State& a, const State& b) {
  double largest = 0;
  for (std::size_t p = 0; p < a.x.x.size(); ++p) {
    const double d = glm::length(position(a, p) - position(b, p));
    largest = d >= 0 ? std::max(largest, d) : std::numeric_limits<double>::infinity();
  }
  return largest;
}

/// The same scene on both engines.
struct Pair {
  explicit Pair(Preset preset) : cpu(preset), opencl((preset.engine = EngineKind::opencl, preset)) {}
  void apply(const Edit& edit) { cpu.apply(edit), opencl.apply(edit); }
  void change(const std::function<void(Preset&)>& what) {
    for (Simulation* simulation : {&cpu, &opencl}) {
      Preset next = simulation->preset();
      what(next);
      simulation->apply(edit::Change{next});
    }
  }
  void advance(int steps) { cpu.advance(steps), opencl.advance(steps); }
  void check() {
    CHECK(opencl.steps() == cpu.steps());
    CHECK(opencl.tears().torn_count() == cpu.tears().torn_count());
    CHECK(opencl.left_inside() == cpu.left_inside());
    CHECK(distance(opencl.read(), cpu.read()) <= tolerance(cpu.preset()));
    // Velocities are as exact as positions over a step of the shortest time in which something happens.
    constexpr double shortest_time = 1e-3;
    for (std::size_t p = 0; p < cpu.read().v.x.size(); ++p)
      if (glm::length(velocity(opencl.read(), p) - velocity(cpu.read(), p)) > tolerance(cpu.preset()) / shortest_time)
        FAIL_CHECK("the velocities of particle ", p, " differ");
  }
  Simulation cpu, opencl;
};

/// A hundred steps of everything(), with the hand, cuts, another pin and a body that is moved; checked on the way.
inline void check_handling(Pair pair) {
  pair.advance(40);
  pair.check();
  pair.apply(edit::Grab{20, 30});
  pair.apply(edit::MoveHand{{0.1, 1.1, 0.4}, 60});
  pair.apply(edit::Cut{{{10, 20}, {10, 21}, {10, 22}, {11, 23}}});
  pair.advance(30);
  pair.check();
  const double hand = glm::length(pair.cpu.hand_force());
  CHECK(hand > 0);
  CHECK(glm::length(pair.opencl.hand_force() - pair.cpu.hand_force()) <= 1e-3 * hand);
  pair.apply(edit::Release{});
  pair.apply(edit::Pin{5, 40, true});
  pair.apply(edit::MoveBody{0, {0.05, 0.72, 0.4}});
  pair.advance(30);
  pair.check();
}

/// Everything that a sweep can have.
inline Preset everything(Precision precision, const std::string& integrator = "verlet") {
  Preset preset = cloth(33, 47, integrator);
  preset.precision = precision;
  preset.tilt_deg = 20;
  preset.W = {0.001, 0.0005, 0.002};
  preset.pins.mode = Pins::Mode::left_column;
  preset.bodies = {Body{}, Body{.shape = Body::Shape::plane, .y = 0.668}};
  preset.bodies[0].c = {0.05, 0.7, 0.4}, preset.bodies[0].r = 0.15;
  preset.bodies[0].friction = 0.4;
  // Who bounces in one step and not in the next goes elsewhere: with float's rounding that would decide.
  preset.bodies[1].restitution = precision == Precision::double_ ? 0.5 : 0;
  preset.bodies.push_back({.shape = Body::Shape::cylinder,
                           .c = {0.3, 0.66, 0.3},
                           .r = 0.08,
                           .length = 0.2,
                           .turn = {30, 0, 70},
                           .velocity = {0, 0.4, 0},
                           .spin = {1, 2, 0},
                           .friction = 0.3});
  return preset;
}

}  // namespace tyglab::test
