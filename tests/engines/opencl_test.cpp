// The OpenCL engine against the CPU engine: the same scenes, the same edits, states equal within rounding. Where there
// is no OpenCL device one line says so and nothing is checked; with one, pocl's on every processor, they check it.
#include <doctest/doctest.h>

#include <glm/geometric.hpp>

#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/opencl/opencl_engine.h"
#include "core/integrators/scheme.h"
#include "tests/engines/engine_pair.h"
#include "tests/support/devices.h"
#include "tests/support/sanitized.h"

namespace tyglab::opencl_test {

using test::distance;
using test::everything;
using test::Pair;
using test::tolerance;

TEST_CASE("every integrator that runs on OpenCL moves a cloth of any size as the CPU engine does") {
  if (test::skipped_without_device()) return;
  for (const Scheme& method : schemes()) {
    if (!runs_on_opencl(method)) continue;
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      for (const auto& [rows, columns] : {std::pair(3, 2), std::pair(17, 5), std::pair(33, 47), std::pair(64, 64)}) {
        CAPTURE(std::string(method.name));
        CAPTURE(int(precision));
        CAPTURE(rows);
        Preset preset = test::cloth(rows, columns, std::string(method.name));
        preset.precision = precision;
        Pair pair(preset);
        pair.advance(test::fewer(100, 20));
        pair.check();
      }
    }
  }
}

TEST_CASE("wind, pins, bodies with friction and restitution, the hand, cuts") {
  if (test::skipped_without_device()) return;
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    CAPTURE(int(precision));
    check_handling(Pair(everything(precision)));
  }
}

TEST_CASE("pins that follow a path and turn move the cloth as on the CPU engine") {
  if (test::skipped_without_device()) return;
  for (const char* method : {"verlet", "implicit_euler"}) {
    CAPTURE(std::string(method));
    Preset preset = test::cloth(9, 11, method);
    preset.pins.mode = Pins::Mode::left_column;
    preset.pins.motions = {{.mode = Pins::Mode::list, .list = {{0, 0}, {1, 0}}, .spin = {0, 0, 3}},
                           {.mode = Pins::Mode::left_column, .path = {{0.01, {0, 0, 0}}, {0.2, {0.05, 0.1, 0.05}}}}};
    Pair pair(preset);
    pair.advance(60);
    pair.check();
    pair.apply(edit::Grab{4, 5});
    pair.advance(10);
    pair.check();
  }
}

TEST_CASE("the hand feels the same force wherever it holds, on the border of two bands too") {
  if (test::skipped_without_device()) return;
  for (const int row : {12, 13, 14, 15, 16, 17}) {
    CAPTURE(row);
    Pair pair(everything(Precision::double_));
    pair.apply(edit::Grab{row, 30});
    pair.apply(edit::MoveHand{{0.1, 1.0, 0.4}, 60});
    for (int n = 0; n < 9; ++n) {
      pair.advance(1 + n);
      CHECK(glm::length(pair.opencl.hand_force() - pair.cpu.hand_force()) <= 1e-6 * glm::length(pair.cpu.hand_force()));
    }
    pair.check();
  }
}

TEST_CASE("steps that are made again, up to the one in which the hand lets go, know its present velocity") {
  if (test::skipped_without_device()) return;
  Preset preset = test::cloth(33, 21);
  preset.precision = Precision::double_, preset.F_release = 3;
  Pair pair(preset);
  const glm::dvec3 at = pair.cpu.positions().at(20, 10);
  pair.apply(edit::Grab{20, 10});
  pair.apply(edit::MoveHand{at + glm::dvec3(0.001, 0, 0), 40});
  pair.advance(40);
  REQUIRE(pair.cpu.held());
  pair.apply(edit::MoveHand{at + glm::dvec3(0, 0.3, 0.5), 150});
  for (Simulation* simulation : {&pair.cpu, &pair.opencl})
    while (simulation->held() && simulation->steps() < 240) simulation->advance(240 - int(simulation->steps()));
  CHECK(!pair.cpu.held());
  pair.check();
}

TEST_CASE("constants change while it moves, and switch features on and off") {
  if (test::skipped_without_device()) return;
  for (const char* integrator : {"verlet", "velocity_verlet"}) {
    CAPTURE(std::string(integrator));
    Preset preset = test::cloth(20, 21, integrator);
    Pair pair(preset);
    pair.advance(20);
    pair.change([](Preset& p) { p.dt /= 2; });
    pair.advance(20);
    pair.change([](Preset& p) { p.k_d = 0, p.k_b = 0, p.k_s = 80; });
    pair.advance(20);
    pair.change([](Preset& p) { p.k_d = 0.003, p.W = {0, 0, 0.002}; });
    pair.advance(20);
    pair.check();
  }
}

TEST_CASE("forces that are linear in positions: B and twist, through cuts, tears, bodies and changes of constants") {
  if (test::skipped_without_device()) return;
  for (const char* integrator : {"verlet", "rk4", "implicit_euler", "tr_bdf2"}) {
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      CAPTURE(std::string(integrator));
      CAPTURE(int(precision));
      Preset preset = everything(precision);
      preset.integrator = integrator, preset.B = 2e-4;
      Pair pair(preset);
      pair.advance(20);
      pair.check();
      pair.apply(edit::Cut{{{5, 6}, {6, 6}, {6, 7}}});
      pair.advance(20);
      pair.change([](Preset& p) { p.twist = 0.3, p.B = 1e-4; });
      pair.advance(20);
      pair.check();
      pair.change([](Preset& p) { p.B = 0; });
      pair.advance(10);
      pair.change([](Preset& p) { p.B = 3e-4, p.k_b = 0; });
      pair.advance(20);
      pair.check();
    }
  }
  // Springs that steps tear by themselves take the constants with them.
  Preset torn = test::cloth(24, 21);
  torn.B = 1e-4, torn.F_max = 0.03, torn.k_s = 100;
  Pair pair(torn);
  pair.advance(250);
  CHECK(pair.cpu.tears().torn_count() > 10);
  pair.check();
}

TEST_CASE("the same springs tear, in the same steps") {
  if (test::skipped_without_device()) return;
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    CAPTURE(int(precision));
    Preset preset = test::cloth(40, 37);
    preset.precision = precision;
    preset.pins.mode = Pins::Mode::left_column;
    preset.F_max = 0.06;
    Pair pair(preset);
    for (int n = 0; n < 12; ++n) {
      pair.advance(15);
      CHECK(pair.opencl.tears().torn_count() == pair.cpu.tears().torn_count());
    }
    CHECK(pair.cpu.tears().torn_count() > 5);
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 37; ++j)
        for (int d = 0; d < int(directions.size()); ++d)
          if (preset.rows > i + directions[d].di)
            if (pair.opencl.tears().whole(d, i, j) != pair.cpu.tears().whole(d, i, j))
              FAIL_CHECK("spring ", d, " of (", i, ", ", j, ") differs");
    pair.check();
  }
}

TEST_CASE("divergence is found in the same step, and the state before it is kept") {
  if (test::skipped_without_device()) return;
  for (const char* integrator : {"verlet", "euler", "rk4"}) {
    CAPTURE(std::string(integrator));
    Preset preset = test::cloth(19, 22, integrator);
    preset.k_d = 0, preset.dt = 2e-3;
    preset.k_s = 500;
    Pair pair(preset);
    while (!pair.cpu.divergence() && pair.cpu.steps() < 2000) pair.cpu.advance(100);
    while (!pair.opencl.divergence() && pair.opencl.steps() < 2000) pair.opencl.advance(77);
    REQUIRE(pair.cpu.divergence().has_value());
    REQUIRE(pair.opencl.divergence().has_value());
    CHECK(pair.opencl.divergence()->step == pair.cpu.divergence()->step);
    CHECK(pair.opencl.divergence()->quantity == pair.cpu.divergence()->quantity);
    CHECK(test::all_finite(pair.opencl.read()));
  }
}

TEST_CASE("an explosion that leaves no spring whole is found in the same step and place") {
  if (test::skipped_without_device()) return;
  for (const char* integrator : {"verlet", "velocity_verlet", "rk4"})
    for (const Precision precision : {Precision::float_, Precision::double_})
      for (const Pins::Mode pins : {Pins::Mode::none, Pins::Mode::left_column}) {
        CAPTURE(std::string(integrator));
        CAPTURE(int(precision));
        Preset preset = test::cloth(32, 33, integrator);
        preset.precision = precision, preset.dt = 1e-3;
        preset.F_max = 0.1, preset.k_s = 1e6, preset.initial_stretch = 1.5;
        preset.tilt_deg = 0, preset.pins.mode = pins;
        Pair pair(preset);
        pair.advance(50);
        REQUIRE(pair.cpu.divergence().has_value());
        REQUIRE(pair.opencl.divergence().has_value());
        // Springs round a pin do not tear, so one of them may be too long.
        if (pins == Pins::Mode::none) CHECK(pair.cpu.divergence()->quantity == "velocity");
        CHECK(pair.opencl.divergence()->quantity == pair.cpu.divergence()->quantity);
        CHECK(pair.opencl.divergence()->step == pair.cpu.divergence()->step);
        CHECK(pair.opencl.divergence()->where() == pair.cpu.divergence()->where());
        CHECK(test::all_finite(pair.opencl.read()));
      }
}

TEST_CASE("batches of steps give the bits of single steps, and every run the same") {
  if (test::skipped_without_device()) return;
  Preset preset = everything(Precision::float_);
  preset.engine = EngineKind::opencl;
  preset.F_max = 0.02;
  Simulation batches(preset), again(preset), single(preset);
  batches.advance(130);
  again.advance(130);
  for (int n = 0; n < 130; ++n) single.advance(1);
  CHECK(batches.tears().torn_count() > 0);
  CHECK(batches.tears().torn_count() == single.tears().torn_count());
  CHECK(test::identical(batches.read(), again.read()));
  CHECK(test::identical(batches.read(), single.read()));
}

TEST_CASE("the hand lets go in the same step") {
  if (test::skipped_without_device()) return;
  Preset preset = test::cloth(20, 20);
  preset.F_release = 0.05;
  Pair pair(preset);
  int released[2] = {-1, -1};
  Simulation* both[] = {&pair.cpu, &pair.opencl};
  for (int which : {0, 1}) {
    both[which]->apply(edit::Grab{15, 10});
    both[which]->apply(edit::MoveHand{{0.5, 0.2, 0.5}, 200});
    const AdvanceResult made = both[which]->advance(200);
    if (made.released) released[which] = int(both[which]->steps());
  }
  CHECK(released[0] > 0);
  CHECK(released[1] == released[0]);
}

TEST_CASE("work-items of one particle, as on graphics cards, and vectors of any width do the same") {
  if (test::skipped_without_device()) return;
  const Preset preset = everything(Precision::float_);
  const Lattice lattice = lattice_of(preset);
  Preset on_cpu = preset;
  Simulation cpu(on_cpu);
  cpu.advance(60);
  for (const int width : {1, 4, 8}) {
    CAPTURE(width);
    const auto engine = opencl::make_opencl_engine(preset, lattice, width);
    Tears tears(lattice);
    engine->set_fixed(particles_in(pinned_particles(preset)), {});
    engine->load(start_rows(preset), tears);
    engine->advance(60, tears);
    State state;
    engine->read(state, tears);
    CHECK(distance(state, cpu.read()) <= tolerance(preset));
  }
}

TEST_CASE("one weight, and the ledger with what bodies stop") {
  if (test::skipped_without_device()) return;
  Pair weight(test::one_weight());
  weight.advance(100);
  weight.check();

  Preset preset = everything(Precision::double_);
  Pair pair(preset);
  pair.cpu.enable_ledger(true), pair.opencl.enable_ledger(true);
  pair.advance(50);
  pair.check();
  const auto contacts = [](Simulation& simulation) { return simulation.engine().contacts(); };
  REQUIRE(contacts(pair.opencl).size() == contacts(pair.cpu).size());
  CHECK(!contacts(pair.cpu).empty());
  for (std::size_t n = 0; n < contacts(pair.cpu).size(); ++n) {
    CHECK(contacts(pair.opencl)[n].particle == contacts(pair.cpu)[n].particle);
    CHECK(glm::length(contacts(pair.opencl)[n].x - contacts(pair.cpu)[n].x) <= 1e-11);
    CHECK(glm::length(contacts(pair.opencl)[n].v - contacts(pair.cpu)[n].v) <= 1e-8);
  }
}

TEST_CASE("what does not run says so and how to go on") {
  Preset preset = test::cloth(4, 4);
  preset.engine = EngineKind::opencl;
  preset.device = 99;
  CHECK_THROWS_WITH_AS(Simulation{preset}, doctest::Contains("--engine cpu"), EngineError);
  preset.device = -1;
  if (test::skipped_without_device()) return;
  for (const char* integrator : {"dopri5", "projective_dynamics", "vbd", "xpbd"}) {
    preset.integrator = integrator;
    CHECK_THROWS_WITH_AS(Simulation{preset}, doctest::Contains(integrator), EngineError);
  }
}

TEST_CASE("a simulation goes from one engine to the other and back") {
  if (test::skipped_without_device()) return;
  Preset preset = test::cloth(20, 30);
  Simulation both(preset), cpu(preset);
  both.advance(30);
  preset.engine = EngineKind::opencl;
  both.apply(edit::Change{preset});
  both.advance(30);
  preset.engine = EngineKind::cpu;
  both.apply(edit::Change{preset});
  both.advance(30);
  // Each time the state is read and loaded again, which is not exact where a method's velocity lags.
  for (int n = 0; n < 3; ++n) {
    if (n > 0) test::load(cpu, State(cpu.read()));
    cpu.advance(30);
  }
  CHECK(both.steps() == 90);
  CHECK(distance(both.read(), cpu.read()) <= tolerance(preset));
}

TEST_CASE("drivers that do not survive the probe count as none, and it is said why") {
  if (test::skipped_without_device()) return;  // it may be this one's drivers
  const std::size_t trusted = opencl_devices().devices.size();
  int probed = 0;
  set_driver_probe([&](const std::function<void()>&) { return ++probed, false; });
  for (int n = 0; n < 2; ++n) {
    const OpenClInventory inventory = opencl_devices();
    CHECK(inventory.devices.empty());
    CHECK(inventory.problem.find("crashes while listing its devices") != std::string::npos);
  }
  CHECK(probed == 2);  // once more, in case it was bad luck, and never again
  set_driver_probe([&](const std::function<void()>& ask) { return ask(), true; });
  CHECK(opencl_devices().devices.size() == trusted);
  test::probe_drivers_in_child();
}

}  // namespace tyglab::opencl_test
