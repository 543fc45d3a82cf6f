// Copies move in lockstep: equal settings give equal bits whatever the hand does, and differences stay differences.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/io/preset_io.h"
#include "core/lockstep.h"
#include "tests/support/scenes.h"

namespace tyglab::lockstep_test {

/// An original with its copies, as the sandbox moves them: an edit goes to all, steps are followed.
struct Pair {
  explicit Pair(const Preset& preset) : original(preset) {}
  void apply(const Edit& edit) {
    original.apply(edit);
    for (const std::string& sentence : copies.apply(original, edit)) gone.push_back(sentence);
  }
  void advance(int steps) {
    original.advance(steps);
    copies.follow(original.time());
  }
  Simulation& copy(std::size_t n = 0) { return *copies[n].simulation; }

  Simulation original;
  Lockstep copies;
  std::vector<std::string> gone;
};

/// Everything that a hand can do to a cloth, with steps between.
void handle(Pair& cloths) {
  cloths.advance(20);
  cloths.apply(edit::Grab{6, 4});
  cloths.apply(edit::MoveHand{{0.2, 0.3, 0.1}, 40});
  cloths.advance(25);
  cloths.apply(edit::MoveHand{{0.1, 0.4, -0.1}, 30});
  cloths.advance(30);
  cloths.apply(edit::Cut{{{5, 2}, {5, 3}}});
  cloths.apply(edit::Release{});
  cloths.apply(edit::Pin{4, 4, true});
  Preset next = cloths.original.preset();
  next.k_s *= 0.7, next.W = {0, 0, 0.001};
  cloths.apply(edit::Change{next});
  cloths.advance(40);
}

TEST_CASE("copies with equal settings stay equal to the bit, from the start or from mid-run") {
  for (const char* integrator :
       {"verlet", "euler", "velocity_verlet", "rk4", "implicit_euler", "projective_dynamics", "vbd", "xpbd"})
    for (const Precision precision : {Precision::float_, Precision::double_})
      for (const int before : {0, 37}) {
        CAPTURE(std::string(integrator));
        CAPTURE(before);
        Preset preset = test::cloth(9, 8, integrator);
        preset.precision = precision, preset.dt = 1e-4;
        Pair cloths(preset);
        cloths.original.advance(before);
        cloths.copies.add(cloths.original, {});
        handle(cloths);
        CHECK(cloths.gone.empty());
        CHECK(cloths.copy().steps() == cloths.original.steps());
        CHECK(test::identical(cloths.original.read_raw(), cloths.copy().read_raw()));
        CHECK(rms_distance(cloths.copy(), cloths.original) == 0);
      }
}

TEST_CASE("another copy added later leaves equal ones equal") {
  Preset preset = test::cloth(8, 8);
  preset.precision = Precision::float_;
  Pair cloths(preset);
  cloths.advance(31);
  cloths.copies.add(cloths.original, {});
  cloths.advance(31);
  cloths.copies.add(cloths.original, {{&Preset::integrator, "rk4"}});
  cloths.advance(31);
  CHECK(test::identical(cloths.original.read_raw(), cloths.copy().read_raw()));
  CHECK(rms_distance(cloths.copy(1), cloths.original) > 0);
}

TEST_CASE("a copy keeps its difference while the original's constants change") {
  Pair cloths(test::cloth(8, 8));
  cloths.copies.add(cloths.original, {{&Preset::k_s, 30}, {&Preset::integrator, "rk4"}});
  Preset next = cloths.original.preset();
  next.k_s = 80, next.k_d = 0.01, next.integrator = "velocity_verlet";
  cloths.apply(edit::Change{next});
  CHECK(cloths.copy().preset().k_s == 30);
  CHECK(cloths.copy().preset().integrator == "rk4");
  CHECK(cloths.copy().preset().k_d == 0.01);
  cloths.advance(50);
  cloths.apply(edit::Restart{});
  CHECK(cloths.copy().time() == 0);
  CHECK(cloths.copy().preset().k_s == 30);
}

TEST_CASE("copies of another dt keep the same time to within one of their steps, the hand's too") {
  Pair cloths(test::cloth(8, 8));
  cloths.copies.add(cloths.original, {{&Preset::dt, 0.0005}});
  cloths.copies.add(cloths.original, {{&Preset::dt, 0.0007}});
  cloths.apply(edit::Grab{7, 7});
  const glm::dvec3 to{0.1, 0.2, 0.3};
  cloths.apply(edit::MoveHand{to, 84});  // of 1 ms, a whole number of all three
  cloths.advance(84);
  CHECK(cloths.copy(0).steps() == 168);
  CHECK(cloths.copy(1).steps() == 120);
  for (const std::size_t n : {0u, 1u}) {
    CHECK(cloths.copy(n).time() == doctest::Approx(cloths.original.time()));
    CHECK(glm::length(cloths.copy(n).positions().at(7, 7) - to) < 1e-9);
  }
  cloths.advance(1);
  CHECK(cloths.copy(1).time() <= cloths.original.time());
  CHECK(cloths.copy(1).time() > cloths.original.time() - 0.0007);
}

TEST_CASE("the distance between two cloths carries the one that lags to the other's time") {
  // All particles fall alike, so the distance is known: what is left of the lag is g Δt²/2.
  Preset preset = test::cloth(4, 4);
  preset.pins.mode = Pins::Mode::none;
  Pair cloths(preset);
  cloths.copies.add(cloths.original, {{&Preset::dt, 0.0007}});
  cloths.advance(100);
  const double lag = cloths.original.time() - cloths.copy().time();
  CHECK(lag == doctest::Approx(0.1 - 142 * 0.0007));
  CHECK(rms_distance(cloths.copy(), cloths.original) == doctest::Approx(preset.g * lag * lag / 2).epsilon(1e-3));
}

TEST_CASE("a copy that diverges stands still and the others go on; restarting mends it") {
  Pair cloths(test::cloth(8, 8));
  cloths.copies.add(cloths.original, {{&Preset::dt, 0.02}});
  cloths.copies.add(cloths.original, {{&Preset::k_s, 40}});
  cloths.advance(3000);
  REQUIRE(cloths.copy(0).divergence().has_value());
  CHECK(std::isnan(rms_distance(cloths.copy(0), cloths.original)));
  CHECK(cloths.copies.alive());
  CHECK(cloths.copy(1).time() == doctest::Approx(cloths.original.time()));
  cloths.apply(edit::Restart{});
  CHECK_FALSE(cloths.copy(0).divergence().has_value());
}

TEST_CASE("going back in time takes the copies along") {
  Pair cloths(test::cloth(8, 8));
  cloths.copies.add(cloths.original, {});
  cloths.copies.add(cloths.original, {{&Preset::k_s, 30}});
  cloths.advance(40);
  const Snapshot then = cloths.original.snapshot();
  cloths.advance(40);
  cloths.original.restore(then);
  CHECK(cloths.copies.resume(cloths.original).empty());
  CHECK(rms_distance(cloths.copy(1), cloths.original) == 0);
  cloths.advance(60);
  CHECK(test::identical(cloths.original.read_raw(), cloths.copy(0).read_raw()));
  CHECK(rms_distance(cloths.copy(1), cloths.original) > 1e-6);
}

TEST_CASE("what cannot be copied is refused, and a copy that cannot follow is gone with a word") {
  Pair cloths(test::cloth(8, 8));
  CHECK_THROWS_WITH_AS(cloths.copies.add(cloths.original, {{&Preset::rows, 9}}),
                       "A copy has the same particles as its original: rows=9 would change them.", PresetError);
  CHECK_THROWS_AS(cloths.copies.add(cloths.original, {{&Preset::k_s, -1}}), PresetError);
  for (std::size_t n = 0; n < Lockstep::most; ++n) cloths.copies.add(cloths.original, {});
  CHECK_THROWS_AS(cloths.copies.add(cloths.original, {}), PresetError);
}

TEST_CASE("a copy that cannot follow a change is gone, with a word") {
  Preset preset = test::cloth(8, 8);
  preset.bodies.push_back({});
  Pair cloths(preset);
  cloths.copies.add(cloths.original, {{0u, &Body::r, 0.1}});
  Preset next = preset;
  next.bodies.clear();
  cloths.apply(edit::Change{next});
  CHECK(cloths.copies.empty());
  REQUIRE(cloths.gone.size() == 1);
  CHECK(cloths.gone[0].find("The copy with bodies[0].r=0.1 was removed: ") == 0);
}

}  // namespace tyglab::lockstep_test
