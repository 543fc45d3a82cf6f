// The recent past that the sandbox keeps.
#include "app/session/rewind.h"

#include <doctest/doctest.h>

#include "tests/support/scenes.h"

namespace tyglab::rewind_test {

TEST_CASE("the past is kept ten times a second and found again") {
  Preset preset = test::cloth(6, 6);
  preset.dt = 0.01, preset.k_s = 0.1, preset.k_b = 0.1, preset.k_d = 0;
  Simulation simulation(preset);
  Rewind past;
  CHECK(past.before(simulation, 0, 1) == nullptr);
  for (int n = 0; n < 300; ++n) past.look(simulation), simulation.advance(1);
  const Snapshot* then = past.before(simulation, simulation.time(), 1);
  REQUIRE(then != nullptr);
  CHECK(then->t <= simulation.time() - 1);
  CHECK(then->t > simulation.time() - 1.2);
  const auto go_back = [&](double seconds) {
    past.go_back(simulation, *past.before(simulation, simulation.time(), seconds));
  };
  go_back(1);
  CHECK(simulation.time() < 2.01);
  go_back(1);
  CHECK(simulation.time() < 1.01);
  go_back(100);  // the oldest
  CHECK(simulation.time() == 0);
}

TEST_CASE("the past of another cloth, or of a motion begun anew, is forgotten") {
  Preset preset = test::cloth(6, 6);
  Simulation simulation(preset);
  Rewind past;
  past.look(simulation);
  simulation.advance(500);
  past.look(simulation);
  simulation.apply(edit::Restart{});
  past.look(simulation);
  CHECK(past.before(simulation, 10, 1)->t == 0);
  CHECK(past.bytes() == simulation.snapshot().bytes());
  Simulation other(test::cloth(7, 6));
  CHECK(past.before(other, 1, 1) == nullptr);
  past.look(other);
  CHECK(past.before(other, 1, 1) != nullptr);
}

TEST_CASE("of a cloth that hardly fits nothing is kept") {
  Simulation simulation(test::cloth(500, 500));
  Rewind past;
  past.look(simulation);
  CHECK(past.bytes() == 0);
  CHECK(past.before(simulation, 0, 1) == nullptr);
}

TEST_CASE("memory is capped") {
  Preset preset = test::cloth(400, 400);
  preset.dt = 0.2;
  preset.g = 0, preset.k_s = preset.k_b = preset.k_d = 0;
  Simulation simulation(preset);
  Rewind past;
  for (int n = 0; n < 20; ++n) past.look(simulation), simulation.advance(1);
  CHECK(past.bytes() <= Rewind::most_bytes);
  CHECK(past.bytes() > Rewind::most_bytes / 2);
  CHECK(past.before(simulation, simulation.time(), 100)->t > 0);
}

}  // namespace tyglab::rewind_test
