// Means over time, where a motion cannot be predicted.
#include "core/analysis/study_run.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/integrators/scheme.h"
#include "tests/support/scenes.h"

namespace tyglab::statistics_test {

TEST_CASE("the mean of blocks and its standard error are those of independent numbers") {
  std::mt19937 random(3);
  std::normal_distribution<double> normal(5, 2);
  std::vector<double> values(4000);
  for (double& value : values) value = normal(random);
  const TimeMean mean = mean_of_blocks(values);
  CHECK(mean.error == doctest::Approx(2 / std::sqrt(4000.0)).epsilon(0.05));
  CHECK(std::abs(mean.mean - 5) < 4 * mean.error);
  CHECK(mean_of_blocks(std::vector<double>{3.0}).error == 0);
}

TEST_CASE("one weight's means are those of its closed form, for what neither grows nor decays") {
  Preset weight = test::one_weight("verlet");
  weight.k_d = 0;
  const double sag = weight.m * weight.g / weight.k, amplitude = weight.offset + sag;
  const AccuracyScene scene{"weight", "one weight", weight, 1};
  const auto all = measure_statistics(scene, true, 2, [] { return false; });
  CHECK(all.size() == integrator_names().size());
  int seen = 0;
  for (const MotionStatistics& row : all) {
    CAPTURE(row.integrator);
    if (row.integrator == "implicit_euler" || row.integrator == "euler") {
      CHECK((row.diverged || std::abs(row.change) > 0.01));
      continue;
    }
    if (row.integrator != "verlet" && row.integrator != "rk4" && row.integrator != "implicit_midpoint") continue;
    ++seen;
    CHECK(!row.diverged);
    CHECK(std::abs(row.height.mean - (weight.x_0.y - sag)) < 4 * row.height.error + 1e-2 * amplitude);
    CHECK(row.kinetic.mean == doctest::Approx(weight.k * amplitude * amplitude / 4).epsilon(0.1));
  }
  CHECK(seen == 3);
}

TEST_CASE("what has been measured before a stop is kept") {
  int asked = 0;
  const AccuracyScene scene{"weight", "one weight", test::one_weight("verlet"), 1};
  const auto some = measure_statistics(scene, true, 1, [&] { return ++asked > 1000; });
  CHECK(!some.empty());
  CHECK(some.size() < integrator_names().size());
}

}  // namespace tyglab::statistics_test
