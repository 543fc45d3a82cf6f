// Stiff implicit stages, whose linear systems several threads solve: the same to the last bit, whoever solves them, and
// whatever was solved before.
#include <doctest/doctest.h>

#include <random>
#include <set>

#include "core/engines/cpu/cpu_engine.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::stiff_stages_test {

/// Of which Newton's method would make nothing.
Preset stiff(int rows, int columns, const std::string& integrator, double k_s) {
  Preset preset = test::cloth(rows, columns, integrator);
  preset.k_s = k_s;
  preset.dt = 1.0 / 60;
  preset.W = {0.002, 0.001, 0.01};
  return preset;
}

/// From one step to the next another number of threads.
void switch_threads(Simulation& simulation, std::set<int>& seen) {
  auto& engine = dynamic_cast<cpu::CpuEngine<double>&>(simulation.engine());
  engine.force_threads([&seen, most = engine.threads(), next = 0]() mutable {
    const int threads = most - next++ % most;
    seen.insert(threads);
    return threads;
  });
}

TEST_CASE("threads that come and go between stiff steps change nothing, to the last bit") {
  // Just large enough for two, since threads that wait for each other on a busy machine take long.
  struct Case {
    const char* integrator;
    double k_s;
    int steps;
  };
  constexpr Case cases[] = {{"implicit_euler", 1e3, 2}, {"tr_bdf2", 1e3, 1}, {"implicit_euler", 3e6, 1}};
  for (const auto& [integrator, k_s, steps] : cases) {
    const bool single = k_s < 1e6;  // precision of the linear systems
    if (test::sanitized && !single) continue;
    CAPTURE(std::string(integrator));
    CAPTURE(k_s);
    const Preset preset = stiff(66, 46, integrator, k_s);
    Simulation alone(preset, 1), switching(preset, 2);
    REQUIRE(switching.engine().threads() == 2);
    std::set<int> seen;
    switch_threads(switching, seen);
    for (int n = 0; n < steps; ++n) alone.advance(1), switching.advance(1);
    CHECK(seen.count(2) == 1);
    CHECK(alone.engine().solves().linear > 30 * steps);
    CHECK(alone.engine().solves().linear == switching.engine().solves().linear);
    CHECK(test::identical(alone.read(), switching.read()));
  }
}

TEST_CASE("a stiff step is the same to the last bit, whatever was solved before it") {
  for (const int side : {16, 31}) {
    CAPTURE(side);
    const Preset preset = stiff(side, side, "implicit_euler", 1e5);
    Simulation used(preset, 1);
    for (int n = 0; n < 3; ++n) {
      CAPTURE(n);
      Simulation fresh(preset, 1);
      test::load(fresh, used.read());
      fresh.advance(1), used.advance(1);
      CHECK(fresh.engine().solves().linear > 30);
      CHECK(test::identical(fresh.read(), used.read()));
    }
  }
}

}  // namespace tyglab::stiff_stages_test
