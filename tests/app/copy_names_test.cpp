// How copies and their original are called: by what tells them apart.
#include <doctest/doctest.h>

#include "app/session/copies.h"
#include "app/session/session.h"
#include "tests/support/scenes.h"

namespace tyglab::copy_names_test {

TEST_CASE("a copy is called by its differences, the original by what its copies change") {
  Session session;
  Preset preset = test::cloth(6, 6);
  preset.k_s = 51.23456, preset.bodies.resize(1);
  session.simulation = std::make_shared<Simulation>(preset);
  const auto add = [&](std::vector<Difference> differences) {
    session.copies.lockstep.add(*session.simulation, std::move(differences));
    return name_of_cloth(session, int(session.copies.lockstep.size()) - 1);
  };
  CHECK(name_of_cloth(session, Copies::original) == "Verlet");
  CHECK(add({}) == "equal copy");
  CHECK(add({{&Preset::k_s, 30}, {&Preset::integrator, "rk4"}}) == "k_s = 30, Runge-Kutta 4");
  CHECK(add({{&Preset::tolerance, 1e-9}, {&Preset::precision, Precision::float_}}) == "tolerance = 1e-9, float");
  CHECK(add({{&Preset::iterations, 20}, {&Preset::dt, 0.1 / 128}}) == "iterations = 20, dt = 7.8125e-4");
  CHECK(add({{0, &Body::r, 0.25}}) == "bodies[0].r = 0.25");
  CHECK(name_of_cloth(session, Copies::original) ==
        "Verlet, bodies[0].r = 0.2, dt = 0.001, iterations = 10, k_s = 51.23, double");
}

TEST_CASE("an accurate solution is called so, and its settings are told whole") {
  Session session;
  Preset preset = test::cloth(6, 6);
  for (const EngineKind engine : {EngineKind::cpu, EngineKind::opencl}) {
    preset.engine = engine;
    session.copies.lockstep.clear();
    session.simulation = std::make_shared<Simulation>(test::cloth(6, 6));
    session.copies.lockstep.add(*session.simulation, copy_choices(preset).front().differences);
    CHECK(name_of_cloth(session, 0) == "accurate solution");
    CHECK(settings_of_cloth(session, 0).starts_with("Dormand-Prince 5(4), tolerance = 1e-9, double"));
  }
  session.copies.lockstep.add(*session.simulation, {{&Preset::integrator, "dopri5"}, {&Preset::tolerance, 1e-8}});
  CHECK(name_of_cloth(session, 1) == "Dormand-Prince 5(4), tolerance = 1e-8");
}

TEST_CASE("of the groups of what copies differ in, methods come first") {
  for (const CopyChoice& choice : copy_choices(test::cloth(6, 6)))
    if (!choice.group.empty()) {
      CHECK(choice.group == "Method");
      break;
    }
}

TEST_CASE("a choice of dt is the number that its label says, to six digits") {
  Preset preset = test::cloth(6, 6);
  preset.dt = 1.0 / 3000;
  for (const CopyChoice& choice : copy_choices(preset))
    if (choice.label.starts_with("dt / 2")) CHECK(*choice.differences.at(0).value_of(&Preset::dt) == 0.000166667);
}

}  // namespace tyglab::copy_names_test
