// Energy over many steps: what `stability drift` measures.
#include "core/analysis/drift.h"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "tests/support/scenes.h"

namespace tyglab {
namespace {

DriftRow measured(const std::string& scene, const std::string& integrator) {
  for (const DriftCase& which : drift_cases(true))
    if (which.scene == scene && which.preset.integrator == integrator)
      return measure_drift(which, [] { return false; });
  throw std::runtime_error("there is no such case");
}

TEST_CASE("a cloth's energy is that of its parts") {
  Preset preset = test::quiet_cloth(2, 3);
  preset.initial_stretch = 2, preset.m = 0.5, preset.k_s = 10, preset.k_b = 7, preset.g = 2;
  preset.v_0 = {0, 0, 3};
  Simulation simulation(preset);
  const Energy e = energy(simulation);
  CHECK(e.kinetic == doctest::Approx(6 * 0.5 / 2 * 9));
  // Along rows 4, along columns 3, diagonals 4, every one twice its length.
  const double L = preset.L;
  CHECK(e.stretch == doctest::Approx(10 / 2.0 * (7 * L * L + 4 * 2 * L * L)));
  CHECK(e.bending == 0);
  CHECK(e.gravity == doctest::Approx(0.5 * 2 * (3 * 1 + 3 * (1 - 2 * L))));
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

}  // namespace
}  // namespace tyglab
