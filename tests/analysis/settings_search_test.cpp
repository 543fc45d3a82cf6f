// Which settings reach an error, at which cost.
#include "core/analysis/settings_search.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/analysis/study_run.h"
#include "core/integrators/scheme.h"
#include "tests/support/scenes.h"

namespace tyglab::settings_search_test {

const Stop never = [] { return false; };

SettingsSearch search(const Preset& preset, const SettingsGoal& goal) {
  return search_settings({preset, std::nullopt}, goal, never, [](const SettingsSearch&) {});
}

ErrorPoint point(const char* method, double dt, double error, double cost) {
  return {.integrator = method, .dt = dt, .error_rms_m = error, .cost = cost};
}

TEST_CASE("the cheapest setting of each method that reaches half the tolerance, the cheapest first") {
  SettingsSearch known;
  known.agreement_rms_m = 1e-9;
  known.points = {point("verlet", 2e-3, 1e-3, 1), point("verlet", 1e-3, 2e-4, 2), point("verlet", 5e-4, 5e-5, 4),
                  point("rk4", 4e-3, 1e-6, 3)};
  const auto reached = settings_for(known, 5e-4);
  REQUIRE(reached.size() == 2);
  CHECK(reached[0].integrator == std::string("verlet"));
  CHECK(reached[0].dt == 1e-3);
  CHECK(reached[1].integrator == std::string("rk4"));
  CHECK(settings_for(known, 3e-4).front().integrator == std::string("rk4"));
  CHECK(settings_for(known, 1e-6).empty());
  CHECK(tightest_tolerance(known) == doctest::Approx(2e-6));
  known.agreement_rms_m = 1e-4;  // two references that differ can promise nothing finer
  CHECK(settings_for(known, 5e-4).empty());
  CHECK(tightest_tolerance(known) == doctest::Approx(1e-3));
}

TEST_CASE("where errors do not fall evenly, a finer setting must confirm a coarser one") {
  SettingsSearch known;
  known.points = {point("verlet", 4e-3, 1e-5, 1), point("verlet", 2e-3, 1e-3, 2), point("verlet", 1e-3, 1e-4, 4),
                  point("verlet", 5e-4, 8e-5, 8)};
  CHECK(settings_for(known, 2.1e-4).front().dt == 4e-3);
  known.rough = true;
  CHECK(settings_for(known, 2.1e-4).front().dt == 1e-3);
  CHECK(settings_for(known, 1.7e-4).empty());  // of the finest nothing is known to confirm it
}

TEST_CASE("a solve that missed its tolerance, a divergence and what was given up are no settings") {
  SettingsSearch known;
  known.points = {point("implicit_euler", 0.1, 1e-6, 1), point("tr_bdf2", 0.1, 1e-6, 1),
                  point("euler", 0.01, std::numeric_limits<double>::infinity(), 1)};
  known.points[0].converged = false, known.points[1].given_up = true;
  CHECK(settings_for(known, 1e-3).empty());
  CHECK(std::isinf(tightest_tolerance(known)));
}

TEST_CASE("a looser tolerance never costs more") {
  const SettingsSearch known = search(test::cloth(6, 6, "verlet"), {.tolerance = 1e-6, .seconds = 0.2});
  REQUIRE(known.problem.empty());
  double before = std::numeric_limits<double>::infinity();
  int found = 0;
  for (double tolerance = tightest_tolerance(known); tolerance < 1; tolerance *= 1.5) {
    const auto reached = settings_for(known, tolerance);
    REQUIRE_FALSE(reached.empty());
    CHECK(reached.front().cost <= before);
    before = reached.front().cost, ++found;
  }
  CHECK(found > 10);
}

TEST_CASE("implicit methods are tried up to a tenth of a second, and win where the cloth is stiff and damped") {
  Preset preset = test::cloth(16, 16, "verlet");
  preset.k_s = 5000;
  const double omega = std::sqrt(12 * preset.k_s / preset.m);
  preset.k_d = 3.5 * 2 * omega * preset.m / 12;  // ζ = 3.5 of the fastest mode
  const SettingsSearch known = search(preset, {.tolerance = 0.02});
  REQUIRE(known.problem.empty());
  const auto longest = std::max_element(known.points.begin(), known.points.end(),
                                        [](const ErrorPoint& a, const ErrorPoint& b) { return a.dt < b.dt; });
  CHECK(longest->dt > 0.05);
  const auto reached = settings_for(known, 0.02);
  REQUIRE_FALSE(reached.empty());
  CHECK(is_implicit(scheme(reached.front().integrator)));
  CHECK(reached.front().dt > 0.005);
}

TEST_CASE(
    "news: nothing new happens in a cloth that hangs, a slack one is caught late, one that falls on a body late") {
  Preset hangs = test::cloth(8, 8, "verlet");
  CHECK(time_of_last_event({hangs, std::nullopt}, 1, never) < 0.6);
  Preset caught = hangs;
  caught.rows = 2, caught.columns = 1, caught.pins.mode = Pins::Mode::top_row;
  caught.L = 2, caught.initial_stretch = 0.5, caught.tilt_deg = 90;  // it falls freely for 1 m, in 0.45 s
  CHECK(time_of_last_event({caught, std::nullopt}, 1, never) > 0.45);
  Preset falls = hangs;
  falls.pins.mode = Pins::Mode::none;
  CHECK(time_of_last_event({falls, std::nullopt}, 1, never) < 0.6);
  Body plane;
  plane.shape = Body::Shape::plane;
  plane.y = falls.x_0.y - 4;  // it falls 4.9 m in a second
  falls.bodies = {plane};
  CHECK(time_of_last_event({falls, std::nullopt}, 1, never) == 1);
}

TEST_CASE("a cloth too large to be followed is refused") {
  const SettingsSearch known = search(test::cloth(4096, 4096, "verlet"), {});
  CHECK(known.problem.find("too large") != std::string::npos);
}

TEST_CASE("the present settings are measured where they are asked for, and progress is told") {
  int told = 0;
  const SettingsSearch known =
      search_settings({test::cloth(8, 8, "verlet"), std::nullopt}, {.tolerance = 1e-4, .seconds = 0.2, .present = true},
                      never, [&](const SettingsSearch&) { ++told; });
  REQUIRE(known.present.has_value());
  CHECK(known.present->integrator == std::string("verlet"));
  CHECK(known.done);
  CHECK(told >= known.methods);
}

TEST_CASE("how far the fine runs are is told evenly up to the first method, with a body too") {
  Preset preset = test::cloth(8, 8, "verlet");
  Body plane;
  plane.shape = Body::Shape::plane;
  plane.y = preset.x_0.y - 4;
  for (const bool bodies : {false, true}) {
    if (bodies) preset.bodies = {plane};
    std::vector<double> parts;
    double whole = 0;
    search_settings({preset, std::nullopt}, {.tolerance = 1e-3, .seconds = 0.1}, never, [&](const SettingsSearch& now) {
      if (now.methods == 0) parts.push_back(now.reference_part);
      CHECK(now.part_done() >= whole);
      whole = now.part_done();
    });
    CAPTURE(bodies);
    REQUIRE(parts.size() > 50);
    CHECK(std::is_sorted(parts.begin(), parts.end()));
    CHECK(parts.back() == doctest::Approx(1));
    double jump = parts.front();
    for (std::size_t n = 1; n < parts.size(); ++n) jump = std::max(jump, parts[n] - parts[n - 1]);
    CHECK(jump < 0.15);
    CHECK(whole == doctest::Approx(1));
  }
}

}  // namespace tyglab::settings_search_test
