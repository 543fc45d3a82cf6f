// The random scenes of `stability stress`: valid, repeatable, and over the whole range of every constant.
#include "tests/bench/stress.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"

namespace tyglab::stress_test {

TEST_CASE("every scene is valid and depends on its seed and number alone") {
  for (std::uint64_t number = 1; number <= 300; ++number) {
    const Preset preset = stress_preset(4, number);
    CAPTURE(number);
    CHECK(check_preset(preset) == "");
    CHECK(preset == stress_preset(4, number));
    CHECK_FALSE(preset == stress_preset(5, number));
  }
}

TEST_CASE("a method that is asked for is every scene's, from the beginning to the end") {
  for (std::uint64_t number = 1; number <= 50; ++number) {
    CAPTURE(number);
    const Preset preset = stress_preset(4, number, "vbd");
    CHECK(check_preset(preset) == "");
    CHECK(preset.integrator == "vbd");
    CHECK(preset.k_s == stress_preset(4, number).k_s);
  }
  int edits = 0;
  for (std::uint64_t number = 1; number <= 20; ++number)
    for (const std::string& edit : run_stress(4, number, "verlet").edits) {
      ++edits;
      CHECK(edit.find("integrator") == std::string::npos);
    }
  CHECK(edits > 10);
}

TEST_CASE("scenes reach into the first and last decade of every logarithmic constant, and take every method") {
  std::map<std::string_view, std::pair<double, double>> reached;
  std::set<std::string> methods;
  for (std::uint64_t number = 1; number <= 2000; ++number) {
    const Preset preset = stress_preset(1, number);
    methods.insert(preset.integrator);
    for (const PresetRow& row : notation())
      if (const auto* field = std::get_if<double Preset::*>(&row.field)) {
        auto& [least, most] = reached.try_emplace(row.key, 1e300, -1e300).first->second;
        least = std::min(least, preset.**field), most = std::max(most, preset.**field);
      }
  }
  CHECK(methods.size() == integrator_names().size());
  for (const PresetRow& row : notation()) {
    if (!reached.contains(row.key)) continue;
    CAPTURE(row.key);
    const auto [least, most] = reached[row.key];
    if (row.scale == Scale::logarithmic) {
      CHECK(most > row.max / 10);
      CHECK(least < (row.min == 0 ? 1e-300 : row.min * 10));
    } else {
      CHECK(most > row.max - 0.1 * (row.max - row.min));
      CHECK(least < row.min + 0.1 * (row.max - row.min));
    }
  }
}

TEST_CASE("thirty cases end bounded, or diverged with all that is to be said") {
  std::map<StressStatus, int> counts;
  for (std::uint64_t number = 1; number <= 30; ++number) {
    CAPTURE(number);
    const StressResult result = run_stress(3, number);
    CHECK_MESSAGE(result.status != StressStatus::failed, result.problem);
    CHECK(result.divergence.has_value() == (result.status == StressStatus::diverged));
    ++counts[result.status];
  }
  CHECK(counts[StressStatus::bounded] > 5);
  CHECK(counts[StressStatus::diverged] > 5);
}

TEST_CASE("a case comes out the same each time") {
  for (const std::uint64_t number : {3, 17, 21}) {
    const StressResult a = run_stress(1, number), b = run_stress(1, number);
    CHECK(a.steps == b.steps);
    CHECK(a.edits == b.edits);
    CHECK(a.status == b.status);
  }
}

}  // namespace tyglab::stress_test
