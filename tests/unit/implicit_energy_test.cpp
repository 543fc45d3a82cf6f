// Implicit Euler never makes energy: with pull-only springs the potential is convex, so a solved step cannot gain.
#include <doctest/doctest.h>

#include <algorithm>

#include "core/simulation.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::implicit_energy_test {

/// The most that the total energy grows in one step, in parts of what the motion can hold.
double largest_growth(double k_s, int iterations, int steps) {
  Preset preset = test::cloth(6, 6, "implicit_euler");
  preset.k_s = k_s, preset.k_b = 0, preset.iterations = iterations;
  preset.dt = 1.0 / 30, preset.precision = Precision::double_;
  Simulation simulation(preset);
  simulation.enable_ledger(true);
  double before = simulation.energy().energy.total(), most = 0;
  for (int n = 0; n < steps; ++n) {
    simulation.advance(1);
    REQUIRE(!simulation.divergence());
    const double now = simulation.energy().energy.total();
    most = std::max(most, now - before);
    before = now;
  }
  return most / simulation.ledger()->scale;
}

TEST_CASE("its energy never grows by more than its solves leave, however stiff the springs" *
          doctest::test_suite("slow")) {
  const int steps = test::fewer(200);
  CHECK(largest_growth(50, 100, steps) < 1e-8);
  CHECK(largest_growth(1e5, 100, steps) < 1e-8);
  CHECK(largest_growth(1e9, 100, steps) < 1e-7);
}

}  // namespace tyglab::implicit_energy_test
