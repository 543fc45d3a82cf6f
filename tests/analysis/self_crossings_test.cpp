// Whether the cloth of a simulation passes through itself, in numbers and words.
#include "core/analysis/self_crossings.h"

#include <doctest/doctest.h>

#include <memory>

#include "tests/support/scenes.h"

namespace tyglab::self_crossings_test {

/// A ribbon of two rows along x that turns back above itself, and goes down through its second quad.
std::unique_ptr<Simulation> turned_in(Precision precision) {
  Preset preset = test::quiet_cloth(2, 8);
  preset.precision = precision;
  auto simulation = std::make_unique<Simulation>(preset);
  State state = simulation->read();
  const double L = preset.L;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 8; ++j) {
      const double along[] = {0, 1, 2, 3, 3.5, 2.5, 1.3, 1.3}, up[] = {0, 0, 0, 0, 1, 1.5, 0.6, -0.4};
      const std::size_t p = 8 * i + j;
      state.x.x[p] = L * along[j], state.x.y[p] = L * up[j], state.x.z[p] = L * (double(i) + 0.1) * (j < 5 ? 1 : 0.9);
    }
  simulation->load(state);
  return simulation;
}

TEST_CASE("a cloth that passes through itself is told, at either precision, and one that hangs is not") {
  for (const Precision precision : {Precision::float_, Precision::double_}) {
    const auto simulation = turned_in(precision);
    CHECK(self_crossings(*simulation).pairs == 3);
    CHECK(crossings_in_words(self_crossings(*simulation)) ==
          "The cloth passes through itself: 3 pairs of triangles cross.");
  }
  Simulation hanging(test::cloth(12, 12));
  hanging.advance(100);
  CHECK(self_crossings(hanging).pairs == 0);
  CHECK(crossings_in_words(self_crossings(hanging)).empty());
}

TEST_CASE("words for one pair, many, and a count that was given up") {
  CHECK(crossings_in_words({.pairs = 1, .listed = {}}) ==
        "The cloth passes through itself: 1 pair of triangles crosses.");
  CHECK(crossings_in_words({.pairs = 12345, .listed = {}, .complete = false}) ==
        "The cloth passes through itself: at least 12,345 pairs of triangles cross.");
  CHECK(crossings_in_words({.pairs = 1, .around_sites = 1, .listed = {}}) ==
        "The cloth passes through itself: 1 pair of triangles crosses, around a site that has parted.");
  CHECK(crossings_in_words({.pairs = 5, .around_sites = 2, .listed = {}}) ==
        "The cloth passes through itself: 5 pairs of triangles cross, 2 of them around a site that has parted.");
}

TEST_CASE("a mass on a spring and a cloth that has diverged have none") {
  CHECK(self_crossings(Simulation(test::one_weight())).pairs == 0);
  Preset preset = test::cloth(6, 6);
  preset.dt = 1;
  Simulation diverged(preset);
  diverged.advance(1000);
  REQUIRE(diverged.divergence());
  CHECK(self_crossings(diverged).pairs == 0);
}

}  // namespace tyglab::self_crossings_test
