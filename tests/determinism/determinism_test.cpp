// The same run is the same to the last bit, however it is cut into calls.
#include <doctest/doctest.h>

#include <random>
#include <set>

#include "core/engines/cpu/cpu_engine.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::determinism_test {

/// Everything at once: wind, bodies, tearing, damping, bending.
Preset busy(const std::string& integrator, Precision precision) {
  Preset preset = test::cloth(19, 17, integrator);
  preset.precision = precision;
  preset.W = {0.002, 0.001, 0.01};
  preset.F_max = 0.15;
  Body sphere;
  sphere.c = {0, 0.75, 0.15};
  sphere.r = 0.1;
  sphere.friction = 0.3;
  sphere.restitution = 0.2;
  preset.bodies = {sphere};
  return preset;
}

/// Under the sanitizers methods with many sweeps a step take a minute each; there one precision shows what both do.
bool skipped_here(const std::string& integrator, Precision precision) {
  const bool long_steps = integrator == "dopri5" || integrator == "rkc2" || integrator == "xpbd" || integrator == "vbd";
  return test::sanitized && long_steps && precision == Precision::double_;
}

TEST_CASE("the same run twice is bit-identical, and so is one step at a time") {
  for (const char* integrator :
       {"verlet", "euler", "improved_euler", "dopri5", "rkc2", "damped_verlet", "projective_dynamics", "vbd", "xpbd"}) {
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      if (skipped_here(integrator, precision)) continue;
      CAPTURE(std::string(integrator));
      const Preset preset = busy(integrator, precision);
      Simulation first(preset), second(preset), single(preset), pieces(preset);
      const int steps = test::fewer(200, 40);
      first.advance(steps);
      second.advance(steps);
      for (int n = 0; n < steps; ++n) single.advance(1);
      for (const int n : {7, steps / 3, 1, steps - 8 - steps / 3}) pieces.advance(n);
      for (Simulation* other : {&second, &single, &pieces}) {
        CHECK(test::identical(first.read(), other->read()));
        CHECK(test::identical(first.read_raw(), other->read_raw()));
        CHECK(first.tears().torn_count() == other->tears().torn_count());
        CHECK(first.time() == other->time());
      }
    }
  }
}

TEST_CASE("reading, and edits that change nothing, do not disturb a run") {
  for (const char* integrator :
       {"verlet", "euler", "improved_euler", "dopri5", "rkc2", "damped_verlet", "projective_dynamics", "vbd", "xpbd"}) {
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      CAPTURE(std::string(integrator));
      const Preset preset = busy(integrator, precision);
      Simulation quiet(preset), watched(preset);
      const int steps = test::fewer(100, 25);
      quiet.advance(steps);
      for (int n = 0; n < steps; ++n) {
        watched.advance(1);
        watched.read();
        watched.particle(3, 4);
        watched.forces(Reduction::maximum);
        watched.apply(edit::Change{preset});
      }
      CHECK(test::identical(quiet.read(), watched.read()));
    }
  }
}

/// Large enough for five threads, with bodies, tearing, the hand and cuts across the threads' borders.
Preset large(const std::string& integrator, Precision precision) {
  Preset preset = busy(integrator, precision);
  preset.rows = 97;
  preset.columns = 83;
  preset.L = 0.01;
  preset.k_b = 8;
  // Each tear would have its matrix factorized anew, which is most of what the test would take.
  if (integrator == "projective_dynamics") preset.F_max = 0;
  // Few passes show it as well, and five threads on two processors mostly wait for each other.
  if (integrator == "projective_dynamics" || integrator == "vbd") preset.iterations = 2;
  return preset;
}

// Under the sanitizers a step takes ten times as long, and five threads on two processors mostly wait.
std::vector<int> team_sizes() {
  return test::sanitized ? std::vector{3} : std::vector{2, 3, 5};
}
constexpr int some_steps = test::fewer(60, 12);
int steps_of(const std::string& integrator) {
  return integrator == "implicit_euler" || integrator == "projective_dynamics" ? 5 : some_steps;
}

TEST_CASE("threads change nothing, to the last bit") {
  for (const char* integrator :
       {"verlet", "euler", "improved_euler", "dopri5", "rkc2", "damped_verlet", "projective_dynamics", "vbd", "xpbd"}) {
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      if (skipped_here(integrator, precision)) continue;
      CAPTURE(std::string(integrator));
      const Preset preset = large(integrator, precision);
      const int steps = steps_of(integrator);
      const auto run = [&](Simulation& simulation) {
        simulation.advance(steps);
        simulation.apply(edit::Grab{50, 40});
        simulation.apply(edit::MoveHand{{0.1, 0.5, 0.2}, 30});
        simulation.apply(edit::Cut{{{19, 5}, {20, 6}, {32, 7}, {48, 41}, {49, 41}, {65, 9}, {78, 60}}});
        simulation.advance(steps);
        simulation.apply(edit::Release{});
        simulation.advance(steps);
      };
      Simulation alone(preset, 1);
      run(alone);
      CHECK(alone.tears().torn_count() > 20);
      for (const int threads : team_sizes()) {
        CAPTURE(threads);
        Simulation team(preset, threads);
        CHECK(team.engine().threads() == threads);
        run(team);
        CHECK(test::identical(alone.read(), team.read()));
        CHECK(test::identical(alone.read_raw(), team.read_raw()));
        CHECK(alone.tears().torn_count() == team.tears().torn_count());
        CHECK(alone.hand_force() == team.hand_force());
        CHECK(alone.divergence().has_value() == team.divergence().has_value());
      }
    }
  }
}

TEST_CASE("rows of narrow cloths, of which many are swept together, have the same bits wherever a band begins") {
  for (const char* integrator : {"verlet", "improved_euler", "velocity_verlet", "rk4", "dopri5"}) {
    for (const int columns : {3, 16, 33}) {
      CAPTURE(std::string(integrator));
      CAPTURE(columns);
      Preset preset = busy(integrator, Precision::float_);
      preset.rows = 4700 / columns, preset.columns = columns, preset.L = 0.01;  // worth three threads
      // A body in the way of twenty rows, whose old positions contacts and the watch need.
      preset.bodies[0].c = Simulation(preset, 1).particle(40, columns / 2).x, preset.bodies[0].r = 10 * preset.L;
      const auto run = [&](Simulation& simulation) {
        simulation.advance(some_steps);
        simulation.apply(edit::Grab{50, columns / 2});
        simulation.apply(edit::MoveHand{{0.1, 0.5, 0.2}, 30});
        simulation.apply(edit::Cut{{{20, 1}, {21, 1}, {65, 2}}});
        simulation.advance(some_steps);
      };
      Simulation alone(preset, 1), team(preset, 3);
      CHECK(team.engine().threads() == 3);
      run(alone), run(team);
      CHECK(test::identical(alone.read_raw(), team.read_raw()));
      CHECK(alone.tears().torn_count() == team.tears().torn_count());
      CHECK(alone.hand_force() == team.hand_force());
    }
  }
}

/// Lets another number of threads make every few steps; `seen` gets the numbers.
template <class R>
void switch_threads(Simulation& simulation, std::set<int>& seen) {
  auto& engine = dynamic_cast<cpu::CpuEngine<R>&>(simulation.engine());
  engine.force_threads([&seen, most = engine.threads(), random = std::mt19937(7)]() mutable {
    const int threads = 1 + int(random() % unsigned(most));
    seen.insert(threads);
    return threads;
  });
}

TEST_CASE("threads that come and go in the middle of a run change nothing, to the last bit") {
  for (const char* integrator : {"verlet", "euler", "rk4", "dopri5", "rkc2", "damped_verlet", "projective_dynamics",
                                 "vbd", "xpbd", "implicit_euler"}) {
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      const bool implicit = std::string(integrator) == "implicit_euler";
      if (skipped_here(integrator, precision) || (implicit && test::sanitized)) continue;
      CAPTURE(std::string(integrator));
      const int steps = steps_of(integrator);
      const Preset preset = large(integrator, precision);
      const auto run = [&](Simulation& simulation) {
        simulation.engine().note_contacts(true);
        simulation.advance(steps);
        simulation.apply(edit::Grab{50, 40});
        simulation.apply(edit::MoveHand{{0.1, 0.5, 0.2}, 30});
        simulation.apply(edit::Cut{{{19, 5}, {20, 6}, {32, 7}, {48, 41}, {49, 41}, {65, 9}, {78, 60}}});
        simulation.advance(steps);
        simulation.apply(edit::Release{});
        simulation.advance(steps);
      };
      Simulation alone(preset, 1), switching(preset, 4);
      std::set<int> seen;
      if (precision == Precision::float_)
        switch_threads<float>(switching, seen);
      else
        switch_threads<double>(switching, seen);
      run(alone);
      run(switching);
      CHECK(seen == std::set{1, 2, 3, 4});
      CHECK(test::identical(alone.read(), switching.read()));
      CHECK(test::identical(alone.read_raw(), switching.read_raw()));
      CHECK(alone.tears().torn_count() == switching.tears().torn_count());
      CHECK(alone.engine().contacts().size() == switching.engine().contacts().size());
      CHECK(alone.hand_force() == switching.hand_force());
    }
  }
}

TEST_CASE("threads find a divergence in the same step at the same particle") {
  Preset preset = large("verlet", Precision::float_);
  preset.dt = 0.004;
  preset.F_max = 0;
  Simulation alone(preset, 1), team(preset, 4), switching(preset, 4);
  std::set<int> seen;
  switch_threads<float>(switching, seen);
  alone.advance(5000);
  REQUIRE(alone.divergence().has_value());
  for (Simulation* other : {&team, &switching}) {
    other->advance(5000);
    REQUIRE(other->divergence().has_value());
    CHECK(alone.divergence()->step == other->divergence()->step);
    CHECK(alone.divergence()->i == other->divergence()->i);
    CHECK(alone.divergence()->j == other->divergence()->j);
    CHECK(test::all_finite(other->read()));
    CHECK(test::identical(alone.read(), other->read()));
  }
}

TEST_CASE("a restart repeats the run to the last bit") {
  Simulation simulation(busy("verlet", Precision::float_));
  simulation.advance(150);
  const State first = simulation.read();
  simulation.apply(edit::Restart{});
  simulation.advance(150);
  CHECK(test::identical(simulation.read(), first));
}

}  // namespace tyglab::determinism_test
