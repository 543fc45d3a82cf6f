// A cloth at rest: it falls asleep, what that leaves out stays within its bound, and everything wakes it.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "app/session/sleep.h"
#include "tests/support/scenes.h"

namespace tyglab::sleep_test {

constexpr int steps_per_frame = 16;

/// Well damped, so that it rests within a few seconds.
Preset soon_at_rest(Precision precision) {
  Preset preset = test::cloth(12, 12);
  preset.precision = precision;
  preset.pins.mode = Pins::Mode::top_row;
  preset.tilt_deg = 88;
  preset.k_d = 0.02;
  preset.dt = 5e-4;
  return preset;
}

/// Steps frame by frame; returns whether it fell asleep within so many simulated seconds.
bool falls_asleep(Simulation& simulation, Sleep& sleep, double seconds, bool touched = false) {
  const double end = simulation.time() + seconds;
  while (simulation.time() < end) {
    sleep.begin(simulation);
    simulation.advance(steps_per_frame);
    sleep.look(simulation, touched);
    if (sleep.asleep(simulation)) return true;
  }
  return false;
}

std::vector<glm::dvec3> places(const Simulation& simulation) {
  const PositionView x = simulation.positions();
  std::vector<glm::dvec3> all;
  for (int i = 0; i < x.rows; ++i)
    for (int j = 0; j < x.columns; ++j) all.push_back(x.at(i, j));
  return all;
}

TEST_CASE("a damped cloth falls asleep, and what it sleeps through is below its bound") {
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    const Preset preset = soon_at_rest(precision);
    Simulation simulation(preset);
    Sleep sleep;
    REQUIRE(falls_asleep(simulation, sleep, 120));
    CHECK(simulation.time() > rest_tolerance(preset).window);
    const auto asleep = places(simulation);
    double error = 0;
    // Its own future: in ten seconds, a dozen swings, it would have gone no farther than this.
    for (int n = 0; n < 200; ++n) {
      simulation.advance(100);
      const auto now = places(simulation);
      for (std::size_t p = 0; p < now.size(); ++p) error = std::max(error, glm::distance(now[p], asleep[p]));
    }
    const double bound = rest_tolerance(preset).error;
    MESSAGE("asleep at t = " << simulation.time() - 10 << " s; error " << error << " m of at most " << bound << " m");
    CHECK(error <= bound);
  }
}

TEST_CASE("what moves does not sleep: a swing without damping, wind, a hand, a touch, one weight") {
  Preset swing = soon_at_rest(Precision::double_);
  swing.tilt_deg = 80;
  swing.k_d = 0;
  Preset windy = soon_at_rest(Precision::double_);
  windy.W = {0, 0, 1e-9};
  Preset slow = soon_at_rest(Precision::double_);  // a large one, whose turning points last long
  slow.L = 1, slow.k_d = 0, slow.tilt_deg = 88, slow.m = 1, slow.k_s = 5e4, slow.dt = 1e-3;
  for (const Preset& preset : {swing, windy, slow, test::one_weight()}) {
    Simulation simulation(preset);
    Sleep sleep;
    CHECK_FALSE(falls_asleep(simulation, sleep, 20));
  }
  Simulation touched(soon_at_rest(Precision::double_));
  Sleep sleep;
  CHECK_FALSE(falls_asleep(touched, sleep, 60, true));
  touched.apply(edit::Grab{6, 6});
  CHECK_FALSE(falls_asleep(touched, sleep, 10));
}

TEST_CASE("every edit wakes it") {
  const Preset preset = soon_at_rest(Precision::float_);
  Preset windy = preset;
  windy.W = {0, 0, 0.01};
  for (const Edit& edit : std::vector<Edit>{edit::Change{windy}, edit::Grab{6, 6}, edit::Cut{{{6, 6}}},
                                            edit::Pin{6, 6, true}, edit::Restart{}}) {
    Simulation simulation(preset);
    Sleep sleep;
    REQUIRE(falls_asleep(simulation, sleep, 120));
    simulation.apply(edit);
    CHECK_FALSE(sleep.asleep(simulation));
    // It is watched anew: a window has to pass first.
    const double window = rest_tolerance(simulation.preset()).window;
    CHECK_FALSE(falls_asleep(simulation, sleep, 0.9 * window));
  }
}

}  // namespace tyglab::sleep_test
