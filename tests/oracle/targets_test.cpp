// Every instruction set that this machine can run (AVX-512, AVX2, SSE, scalar …) against the oracle: the engine picks
// the best one, so without this the others would go untested.
#include <doctest/doctest.h>

#include <set>

#include "tests/oracle/oracle.h"
#include "tests/support/scenes.h"
#include "tests/support/targets.h"

namespace tyglab::targets_test {

/// Everything that the sweep treats apart: wind, bending, damping, pins, a hand, tears.
void compare(int rows, int columns, const std::string& integrator, Precision precision, double tolerance) {
  Preset preset = test::cloth(rows, columns, integrator);
  preset.W = {2e-3, 1e-3, -4e-3};
  preset.k_s = 5;
  preset.x_0 = {0, 0.05, 0};  // near the origin, where what lies behind the last column seems to be
  preset.precision = precision;
  const State state = test::crumpled(preset, 7, 0.3, 0.3);
  Simulation simulation(preset);
  oracle::Cloth cloth(preset);
  test::load(simulation, state);
  test::load(cloth, state);
  const auto advance = [&](int steps) {
    simulation.advance(steps);
    cloth.advance(steps);
    CHECK(test::distance(simulation, cloth) < tolerance);
  };
  advance(40);
  simulation.apply(edit::Grab{rows - 1, columns / 2});
  cloth.grab(rows - 1, columns / 2);
  advance(20);
  for (int i = 1; i < rows; i += 2) {
    simulation.apply(edit::Cut{{{i, i % columns}}});
    cloth.cut(i, i % columns);
  }
  advance(40);
}

TEST_CASE("every instruction set agrees with the oracle" * doctest::test_suite("slow")) {
  std::set<std::string> names;
  for (const std::int64_t target : test::targets()) {
    const test::OnlyTarget only(target);
    CAPTURE(std::string(hwy::TargetName(target)));
    names.insert(Simulation(test::cloth(2, 1)).engine().name());
    for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
      for (const auto& [rows, columns] : {std::pair{2, 1},
                                          {3, 1},
                                          {2, 2},
                                          {3, 3},
                                          {4, 5},
                                          {5, 8},
                                          {6, 9},
                                          {3, 16},
                                          {4, 17},
                                          {5, 18},
                                          {4, 31},
                                          {17, 34}}) {
        CAPTURE(std::string(integrator));
        CAPTURE(rows);
        CAPTURE(columns);
        compare(rows, columns, integrator, Precision::double_, 1e-10);
        compare(rows, columns, integrator, Precision::float_, 2e-5);
      }
    }
  }
  MESSAGE("tried " << names.size() << " kinds of engine, of " << test::targets().size() << " targets");
}

}  // namespace tyglab::targets_test
