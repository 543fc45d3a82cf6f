// Energy over many steps: what `stability drift` measures.
#include "tests/bench/drift.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/scenes.h"

namespace tyglab::drift_test {

DriftRow measured(const std::string& scene, const std::string& integrator) {
  for (const DriftCase& which : drift_cases(true))
    if (which.scene == scene && which.preset.integrator == integrator)
      return measure_drift(which, [] { return false; });
  throw std::runtime_error("there is no such case");
}

TEST_CASE("on the taut sheet symplectic methods keep their energy, others lose or gain it") {
  for (const char* name : {"verlet", "velocity_verlet", "semi_implicit_euler"}) {
    CAPTURE(name);
    const DriftRow row = measured("taut_sheet", name);
    CHECK(row.diverged_at == 0);
    CHECK(row.t.size() == row.energy.size());
    CHECK(std::abs(row.trend) < 3 * row.trend_error);
  }
  CHECK(measured("taut_sheet", "rk4").trend < -0.01);
  CHECK(measured("taut_sheet", "implicit_euler").trend < -0.02);
  CHECK(measured("taut_sheet", "euler").diverged_at > 0);
}

TEST_CASE("on a slack sheet springs that switch feed energy even into Verlet") {
  const DriftRow row = measured("slack_sheet", "verlet");
  CHECK(row.diverged_at == 0);
  CHECK(row.trend > 10 * row.trend_error);
}

}  // namespace tyglab::drift_test
