// dt chosen by linear theory and watched by the ledger; the way back to a snapshot.
#include "core/energy/auto_step.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "core/simulation.h"
#include "core/theory/advice.h"
#include "tests/support/scenes.h"

namespace tyglab::auto_step_test {

TEST_CASE("two digits below a number are never above it") {
  CHECK(two_digits_below(0.0011988) == 0.0011);
  CHECK(two_digits_below(0.0012) == 0.0012);
  CHECK(two_digits_below(9.99e-5) == 9.9e-5);
  CHECK(two_digits_below(0.01) == 0.01);
  for (double dt = 1e-7; dt < 1; dt *= 1.37) {
    CHECK(two_digits_below(dt) <= dt * (1 + 1e-9));
    CHECK(two_digits_below(dt) > 0.9 * dt);
  }
}

TEST_CASE("the chosen dt is stable in any configuration, and none is chosen where none is") {
  for (const char* method : {"verlet", "velocity_verlet", "semi_implicit_euler", "rk4", "euler"}) {
    const Preset preset = test::cloth(8, 8, method);
    const auto dt = AutoStep::choose(preset);
    REQUIRE(dt);
    CHECK(*dt <= AutoStep::margin * stable_dt(preset, method));
    CHECK(*dt > 0.7 * stable_dt(preset, method));
  }
  CHECK(AutoStep::choose(test::cloth(8, 8, "implicit_euler")) == AutoStep::longest);
  Preset undamped = test::cloth(8, 8, "euler");
  undamped.k_d = 0;
  CHECK(!AutoStep::choose(undamped));
}

TEST_CASE("dt is halved where energy is made within a second, and not by what came before") {
  Preset preset = test::cloth(4, 4);
  preset.dt = 0.001;
  LedgerReading ledger;
  ledger.scale = 10;
  AutoStep step;
  CHECK(!step.look(preset, 0, ledger));
  ledger.energy.kinetic = 0.15;
  CHECK(!step.look(preset, 0.5, ledger));
  ledger.energy.kinetic = 0.25;
  CHECK(step.look(preset, 0.9, ledger) == 0.0005);
  CHECK(!step.look(preset, 1, ledger));  // a fresh second
  ledger.energy.kinetic = 0.4;
  CHECK(!step.look(preset, 2.1, ledger));  // slow enough
  ledger.works.contact = 0.5, ledger.energy.kinetic = 0.9;
  CHECK(step.look(preset, 2.2, ledger));  // bodies only take
  preset.dt = 1.5e-7;
  ledger.energy.kinetic = 5;
  CHECK(!step.look(preset, 2.3, ledger));
  ledger.energy.kinetic = 10;
  CHECK(!step.look(preset, 2.4, ledger));  // below what presets allow
}

TEST_CASE("a snapshot brings back positions, velocities, tears and time, and forgets a divergence") {
  Preset preset = test::cloth(10, 10);
  preset.F_max = 0.05, preset.dt = 1e-3;
  for (const char* method : {"verlet", "velocity_verlet", "implicit_euler"}) {
    CAPTURE(method);
    preset.integrator = method;
    Simulation simulation(preset);
    simulation.advance(200);
    const Snapshot then = simulation.snapshot();
    CHECK(simulation.fits(then));
    simulation.apply(edit::Cut{{{5, 5}}});
    Preset wild = simulation.preset();
    wild.dt = 0.5, wild.integrator = "verlet";
    simulation.apply(edit::Change{wild});
    simulation.advance(1000);
    REQUIRE(simulation.divergence());
    simulation.apply(edit::Change{preset});
    simulation.restore(then);
    CHECK(!simulation.divergence());
    CHECK(simulation.time() == then.t);
    CHECK(simulation.steps() == 200);
    CHECK(simulation.tears().torn_count() == then.tears.torn_count());
    double away = 0;
    const State& now = simulation.read();
    for (std::size_t p = 0; p < now.x.x.size(); ++p)
      away = std::max(away, glm::length(test::position(now, p) - test::position(then.state, p)));
    CHECK(away == 0);
    simulation.advance(50);
    CHECK(!simulation.divergence());
    CHECK(simulation.steps() == 250);
  }
  CHECK(!Simulation(test::cloth(9, 10)).fits(Simulation(preset).snapshot()));
}

}  // namespace tyglab::auto_step_test
