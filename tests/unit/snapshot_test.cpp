// Going back to a moment: the same motion follows that followed then.
#include <doctest/doctest.h>

#include <string>

#include "core/integrators/scheme.h"
#include "core/simulation.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::snapshot_test {

/// Blown upon, torn and struck: all that a step may have to do.
Preset eventful(const Scheme& method, Precision precision) {
  Preset preset = test::cloth(14, 11, std::string(method.name));
  preset.precision = precision;
  preset.F_max = 0.05, preset.W = {0.0004, 0, 0.0002}, preset.gust = 0.5;
  preset.bodies = {Body{.c = {0.1, 0.8, 0}, .r = 0.1}};
  preset.dt = 7e-4;
  return preset;
}

TEST_CASE("from a snapshot the same steps follow, to the last bit, with every method" * doctest::test_suite("slow")) {
  const int before = test::fewer(137, 30), after = test::fewer(211, 40);
  for (const Scheme& method : schemes())
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      CAPTURE(std::string(method.name));
      CAPTURE(int(precision));
      Simulation simulation(eventful(method, precision));
      simulation.advance(before);
      const Snapshot then = simulation.snapshot();
      simulation.advance(after);
      const State first = simulation.read_raw();
      const double t = simulation.time();
      simulation.restore(then);
      CHECK(simulation.steps() == before);
      simulation.advance(after);
      CHECK(test::identical(first, simulation.read_raw()));
      CHECK(simulation.time() == t);
    }
}

TEST_CASE("with other constants, or in another precision, a method starts again from a snapshot's velocities") {
  Simulation simulation(eventful(scheme("verlet"), Precision::float_));
  simulation.advance(137);
  const Snapshot then = simulation.snapshot();
  Preset stiffer = simulation.preset();
  stiffer.k_s *= 2, stiffer.dt /= 2;
  simulation.apply(edit::Change{stiffer});
  simulation.restore(then);
  Simulation fresh(stiffer);
  Snapshot without = then;
  without.held.reset();
  fresh.restore(without);
  simulation.advance(50), fresh.advance(50);
  CHECK(test::identical(fresh.read_raw(), simulation.read_raw()));

  stiffer = then.of, stiffer.precision = Precision::double_;
  Simulation finer(stiffer), plain(stiffer);
  finer.restore(then), plain.restore(without);
  finer.advance(50), plain.advance(50);
  CHECK(test::identical(plain.read_raw(), finer.read_raw()));
}

}  // namespace tyglab::snapshot_test
