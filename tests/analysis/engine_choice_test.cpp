// --engine auto: what is chosen for given times, and that measured ones are kept.
#include <doctest/doctest.h>

#include <cstdlib>

#include "core/analysis/settings_search.h"
#include "tests/support/devices.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace tyglab::engine_choice_test {

EngineTime cpu(double ns) {
  return {EngineKind::cpu, -1, "the CPU engine", ns, {}};
}
EngineTime device(int number, double ns, const std::string& fault = {}) {
  return {EngineKind::opencl, number, "OpenCL on a device", ns, fault};
}

TEST_CASE("the quickest engine is chosen, the CPU's where it is nearly so, and the sentence says why") {
  CHECK(choose_among({cpu(1), device(0, 2)}, true).engine == EngineKind::cpu);
  CHECK(choose_among({cpu(1), device(0, 0.97)}, true).engine == EngineKind::cpu);
  const EngineChoice quick = choose_among({cpu(1), device(0, 0.5), device(1, 0.25), device(2, 0.3)}, false);
  CHECK(quick.engine == EngineKind::opencl);
  CHECK(quick.device == 1);
  CHECK(
      quick.why ==
      "OpenCL on a device: 0.25 ns per particle and step in this scene, compared with 0.3 ns with OpenCL on a device, "
      "measured in an earlier run");
  const EngineChoice alone = choose_among({cpu(1), device(0, 0, "it has not enough memory")}, true);
  CHECK(alone.engine == EngineKind::cpu);
  CHECK(alone.why == "the CPU engine, since no other engine runs this scene: it has not enough memory");
  CHECK(choose_among({cpu(0), device(0, 1)}, true).engine == EngineKind::cpu);
}

TEST_CASE("what no device runs is not measured") {
  const EngineChoice choice = choose_engine(test::cloth(8, 8, "xpbd"), 1);
  CHECK(choice.engine == EngineKind::cpu);
  CHECK(choice.times.empty());
  CHECK(choice.why == "the CPU engine, since no other engine runs xpbd");
}

TEST_CASE("times are measured once and then read from disk, for scenes of the same kind") {
  if (test::skipped_without_device()) return;
  const test::TemporaryFolder folder;
  ::setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
  const Preset preset = test::cloth(24, 24);
  const EngineChoice first = choose_engine(preset, 1), again = choose_engine(preset, 1);
  CHECK(first.measured);
  CHECK_FALSE(again.measured);
  REQUIRE(again.times.size() == first.times.size());
  CHECK(first.times.size() >= 2);
  for (std::size_t n = 0; n < first.times.size(); ++n) {
    CHECK(first.times[n].ns > 0);
    CHECK(again.times[n].ns == doctest::Approx(first.times[n].ns).epsilon(1e-4));
  }
  CHECK(again.engine == first.engine);
  Preset windy = preset;
  windy.W = {0, 0, 0.01};
  CHECK(choose_engine(windy, 1).measured);
}

}  // namespace tyglab::engine_choice_test
