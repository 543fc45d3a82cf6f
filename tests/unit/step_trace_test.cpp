// A step written out must be the step that is made, and its springs must sum to the forces of the oracle.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "core/integrators/scheme.h"
#include "core/step_trace.h"
#include "tests/support/scenes.h"

namespace tyglab::step_trace_test {

constexpr int middle = 6;

TEST_CASE("a step that is written out ends where the engine's step ends") {
  for (const Scheme& method : schemes()) {
    Preset preset = test::cloth(13, 13, std::string(method.name));
    preset.W = {0, 0, 0.001};
    Simulation simulation(preset);
    test::load(simulation, test::crumpled(preset, 7));
    simulation.advance(3);
    for (const Pins::Site site : {Pins::Site{middle, middle}, {0, 4}, {12, 0}, {5, 12}}) {
      CAPTURE(std::string(method.name));
      CAPTURE(site.i);
      CAPTURE(site.j);
      const StepTrace trace = trace_step(simulation, site.i, site.j);
      CHECK(trace.whole ==
            (!is_implicit(method) && !chooses_steps(method) && !projects(method) && !solves_damping(method)));
      if (!trace.whole) continue;
      CHECK(trace.stages.size() == method.sweeps.size());
      Simulation& same = simulation;
      const State before = same.read_raw();
      CHECK(glm::length(trace.x - test::position(before, std::size_t(site.i) * 13 + std::size_t(site.j))) == 0);
    }
    const StepTrace trace = trace_step(simulation, middle, middle);
    simulation.advance(1);
    const glm::dvec3 made = simulation.positions().at(middle, middle);
    CAPTURE(std::string(method.name));
    // One that solves is made by a copy, which begins from the velocities that are shown: not to the last digit.
    CHECK(glm::length(trace.x_after - made) < (trace.whole ? 1e-13 : 1e-7));
  }
}

TEST_CASE("the springs of a written-out step sum to the forces on the particle") {
  Preset preset = test::cloth(13, 13);
  Simulation simulation(preset);
  test::load(simulation, test::crumpled(preset, 3));
  const StepTrace trace = trace_step(simulation, middle, middle);
  REQUIRE(trace.stages.size() == 1);
  const TracedStage& stage = trace.stages.front();
  CHECK(stage.stencils.size() == 8 + 4 + 8);  // springs of both kinds, and damping
  PerForce<glm::dvec3> sum;
  for (const StencilForce& spring : stage.stencils) {
    sum[*spring.force] += spring.F;
    if (spring.force == &force::stretch && spring.length <= spring.rest) CHECK(glm::length(spring.F) == 0);
    if (spring.force == &force::bend && spring.length >= spring.rest) CHECK(glm::length(spring.F) == 0);
  }
  for (const Force* force : {&force::stretch, &force::bend, &force::damping})
    CHECK(glm::length(sum[*force] - stage.forces[*force]) < 1e-15);
  const glm::dvec3 F = stage.forces.F_int() + stage.forces.F_ext();
  CHECK(glm::length(stage.a - F / preset.m) < 1e-9);
}

TEST_CASE("what is pinned feels forces but none moves it; torn springs are gone") {
  Preset preset = test::cloth(13, 13);
  preset.pins.mode = Pins::Mode::list;
  preset.pins.list = {{middle, middle}};
  Simulation simulation(preset);
  simulation.advance(20);
  simulation.apply(edit::Cut{{{middle, middle}}});
  const StepTrace trace = trace_step(simulation, middle, middle);
  CHECK(trace.fixed);
  CHECK(glm::length(trace.stages.front().a) == 0);
  CHECK(trace.x_after == trace.x);
  // Three upward, the bending spring that needs one of them, and the damping of those three are gone.
  CHECK(trace.stages.front().stencils.size() == 20 - 3 - 1 - 3);
}

TEST_CASE("state vectors are called by what they are") {
  CHECK(vector_name(scheme("verlet"), vector_v) == "d");
  CHECK(vector_name(scheme("euler"), vector_v) == "v");
  CHECK(vector_name(scheme("velocity_verlet"), 2) == "v*");
  CHECK(vector_name(scheme("rk4"), 2) == "X");
  CHECK(vector_name(scheme("rk4"), 3) == "V");
  CHECK(vector_name(scheme("rk4"), 4) == "x*");
  CHECK(vector_name(scheme("rk4"), 5) == "v*");
}

}  // namespace tyglab::step_trace_test
