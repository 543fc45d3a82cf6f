// The gauge under dt: the limits that it works out beside the frames, and what it says of them.
#include "app/studies/stability_watch.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "app/ui/constants/constants_panel.h"
#include "app/ui/state/ui.h"
#include "core/integrators/scheme.h"
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
  CHECK(soft.every > *soft.now);
  preset.k_s *= 100, preset.k_b *= 100;
  simulation.apply(edit::Change{preset});
  const StabilityLimits stiff = limits_of(simulation);
  CHECK(stiff.any < soft.any / 8);
  CHECK(stability_text(stiff, 2 * stiff.any) == "2 ×");
  CHECK(stability_text(stiff, 0.75 * stiff.any) == "75 %");
}

StabilityLimits made_up(double now) {
  StabilityLimits limits;
  limits.of.integrator = "verlet";
  limits.any = 1e-3, limits.every = 3.46e-3, limits.now = now, limits.omega = 1550;
  return limits;
}

TEST_CASE("the gauge says its three zones in words, and dt in parts of both limits") {
  const StabilityLimits limits = made_up(1.29e-3);
  const std::string stable = stability_words(limits, 7.5e-4);
  CHECK(says(stable, "Stable in any shape: dt is 75 % of the worst-case limit, 58 % of this cloth's as it hangs now."));
  CHECK(says(stable, "guide, not a guarantee"));
  CHECK(says(stability_words(limits, 1.2e-3),
             "Depends on the shape: dt is 120 % of the worst-case limit, 93 % of this cloth's"));
  CHECK(says(stability_words(limits, 4e-3),
             "Unstable in every shape: dt is 4 times the worst-case limit, 3.1 times this cloth's"));
}

TEST_CASE("each mark of the gauge says what it is; the cloth's own limit is no promise") {
  const auto marks = gauge_marks(made_up(1.29e-3), 7.5e-4);
  REQUIRE(marks.size() == 4);
  CHECK(says(marks[0].words, "this cloth's own limit as it hangs now: 0.00129 s"));
  CHECK(says(marks[0].words, "guarantees nothing"));
  CHECK(says(marks[1].words, "the worst-case limit, 0.001 s. Up to it, Verlet is stable in any shape"));
  CHECK(says(marks[2].words, "above 0.00346 s, Verlet is unstable in every shape in which a spring pulls"));
  CHECK(says(marks[3].words, "dt is 75 %"));
  const double infinity = std::numeric_limits<double>::infinity();
  for (const GaugeMark& mark : gauge_marks(made_up(infinity), 1e-3)) CHECK(mark.name != "this cloth");  // it is slack
  StabilityLimits weight = made_up(1e-3);
  weight.of.kind = Kind::one_weight, weight.every = weight.any;
  CHECK(gauge_marks(weight, 1e-3).size() == 2);
  CHECK(part_words(weight, 7.5e-4) == "dt is 75 % of the limit.");
}

TEST_CASE("the worst-case limit is always in the gauge's middle, and no dt beyond its end") {
  const StabilityLimits limits = made_up(1.29e-3);
  CHECK(gauge_position(limits, limits.any) == 0.5);
  CHECK(gauge_position(limits, 1) < 1);
  CHECK(gauge_position(limits, 1e-3) < gauge_position(limits, 1.1e-3));
}

TEST_CASE("methods without a limit, and those that no dt makes stable, are named so") {
  Preset preset = test::cloth(8, 8, "implicit_euler");
  Simulation simulation(preset);
  CHECK(stability_text(limits_of(simulation), preset.dt) == "no limit");
  preset.integrator = "euler", preset.k_d = 0;
  simulation.apply(edit::Change{preset});
  const StabilityLimits euler = limits_of(simulation);
  CHECK(stability_text(euler, preset.dt) == "unstable at any dt");
  CHECK(says(stability_words(euler, preset.dt), "No dt is stable"));
}

TEST_CASE("of rkc2 the region of its stages is drawn, and the cloth's bounds lie within it") {
  Preset preset = test::cloth(8, 8, "rkc2");
  preset.k_d = 0.14, preset.k_b = 0, preset.dt = 0.02;
  const StabilityRegion region = stability_region(scheme("rkc2"), preset);
  CHECK(region.h < preset.dt);
  CHECK(region.stages > 4);
  REQUIRE(region.x.size() == region.y.size());
  CHECK(region.x.front() <= -region.bounds.radius);
  CHECK(region.x.back() == 0);
  for (std::size_t n = 0; n + 1 < region.x.size(); ++n) {
    const double x = region.x[n], circle = region.bounds.circle;
    CHECK(region.y[n] * region.y[n] >= -x * (2 * circle + x));
    CHECK(std::abs(rkc2_growth(region.stages, {x, 0.999 * region.y[n]})) <= 1);
    CHECK(std::abs(rkc2_growth(region.stages, {x, 1.01 * region.y[n] + 0.02})) > 1);
  }
  Simulation simulation(preset);
  const StabilityLimits limits = limits_of(simulation);
  REQUIRE(limits.region.has_value());
  CHECK(limits.region->stages == region.stages);
  CHECK(stability_text(limits, preset.dt) == "no limit");
}

TEST_CASE("after a divergence the limits are the cloth's as it starts, not the wreck's") {
  Preset preset = test::cloth(12, 12);
  preset.initial_stretch = 1.05;
  const StabilityLimits before = [&] {
    Simulation at_rest(preset);
    return limits_of(at_rest);
  }();
  Simulation simulation(preset);
  Preset wild = preset;
  wild.dt = 1.2 * before.every;
  simulation.apply(edit::Change{wild});
  for (int n = 0; n < 1000 && !simulation.divergence(); ++n) simulation.advance(100);
  REQUIRE(simulation.divergence().has_value());
  simulation.apply(edit::Change{preset});
  const StabilityLimits after = limits_of(simulation);
  CHECK(after.at_start);
  CHECK_FALSE(before.at_start);
  REQUIRE(after.now.has_value());
  CHECK(*after.now == *before.now);
  CHECK(after.omega == before.omega);
  CHECK(says(stability_words(after, preset.dt), "at the start"));
}

TEST_CASE("a cloth too large to look at while it moves has the limit of any configuration alone") {
  Preset preset = test::cloth(200, 200);
  Simulation simulation(preset);
  const StabilityLimits limits = limits_of(simulation);
  CHECK(limits.any > 0);
  CHECK_FALSE(limits.now.has_value());
}

}  // namespace tyglab::stability_watch_test
