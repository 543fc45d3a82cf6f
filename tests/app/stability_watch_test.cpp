// The gauge under dt: the limits that it works out beside the frames, and what it says of them.
#include "app/studies/stability_watch.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "app/ui/constants/stability_row.h"
#include "app/ui/state/ui.h"
#include "core/theory/advice.h"
#include "tests/support/scenes.h"

namespace tyglab::stability_watch_test {

/// Polls as frames do until limits for these constants are there.
StabilityLimits limits_of(Simulation& simulation) {
  StabilityWatch watch;
  StudyMoment moment{simulation};
  for (int n = 0; n < 2000; ++n) {
    watch.poll(moment);
    if (watch.limits() && watch.limits()->of == simulation.preset()) return *watch.limits();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  FAIL("no limits came");
  return {};
}

bool says(const std::string& text, const char* what) {
  return text.find(what) != std::string::npos;
}

TEST_CASE("the limits are those of linear theory, and follow the constants") {
  Preset preset = test::cloth(12, 12);
  preset.initial_stretch = 1.05;
  Simulation simulation(preset);
  const StabilityLimits soft = limits_of(simulation);
  CHECK(soft.any == doctest::Approx(stable_dt(preset, preset.integrator)).epsilon(1e-3));
  REQUIRE(soft.now.has_value());
  CHECK(*soft.now > soft.any);
  preset.k_s *= 100, preset.k_b *= 100;
  simulation.apply(edit::Change{preset});
  const StabilityLimits stiff = limits_of(simulation);
  CHECK(stiff.any < soft.any / 8);
  CHECK(stability_text(stiff, 2 * stiff.any) == "2.00");
  const std::string words = stability_words(stiff, 2 * stiff.any);
  CHECK(says(words, "2.00 of the largest"));
  CHECK(says(words, "not a guarantee"));
}

TEST_CASE("methods without a limit, and those that no dt makes stable, are named so") {
  Preset preset = test::cloth(8, 8, "implicit_euler");
  Simulation simulation(preset);
  CHECK(stability_text(limits_of(simulation), preset.dt) == "no limit");
  preset.integrator = "euler", preset.k_d = 0;
  simulation.apply(edit::Change{preset});
  const StabilityLimits euler = limits_of(simulation);
  CHECK(stability_text(euler, preset.dt) == "always above");
  CHECK(says(stability_words(euler, preset.dt), "No dt is stable"));
}

TEST_CASE("a cloth too large to look at while it moves has the limit of any configuration alone") {
  Preset preset = test::cloth(200, 200);
  Simulation simulation(preset);
  const StabilityLimits limits = limits_of(simulation);
  CHECK(limits.any > 0);
  CHECK_FALSE(limits.now.has_value());
}

}  // namespace tyglab::stability_watch_test
