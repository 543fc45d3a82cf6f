// The lab on a cloth that tears, played: as it asks, and otherwise.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "app/session/observables.h"
#include "tests/app/lab_player.h"

namespace tyglab::lab_tearing_test {

using test::finish;
using test::LabPlayer;

double value(LabPlayer& play, const char* name) {
  const auto known = observe(play.session(), name);
  REQUIRE(known.has_value());
  return *known;
}

LabPlayer at_step(int step) {
  LabPlayer play("17_how_it_tears");
  for (int k = 0; k < step; ++k) play.skip();
  return play;
}

/// Cuts along a row, from one column to another.
void cut_row(LabPlayer& play, int row, int from, int to) {
  std::vector<Pins::Site> sites;
  for (int j = from; j <= to; ++j) sites.push_back({row, j});
  play.cut(sites);
}

/// Lowers F_max by 2 % at a time until the step is done, and returns it; or 0 at `least`.
double lower_F_max(LabPlayer& play, double from, double least) {
  for (double F_max = from; F_max > least; F_max *= 0.98) {
    play.set("F_max=" + std::to_string(F_max));
    play.run(0.6);
    if (play.done() || value(play, "torn") > 40) return F_max;
  }
  return 0;
}

TEST_CASE("lab: how it tears, springs or cells") {
  LabPlayer play("17_how_it_tears");
  play.choose(1);
  play.run(2);
  CHECK_FALSE(play.done());
  play.run(3);
  finish(play);
  CHECK(value(play, "area") == doctest::Approx(0.620).epsilon(2e-3));
  CHECK(value(play, "torn") == 160);
  play.next();
  play.choose(2);
  play.restart();
  play.run(5);
  CHECK_FALSE(play.done());  // springs break as before
  play.restart();
  play.set("tearing.mode=split");
  play.run(5);
  finish(play);
  CHECK(value(play, "particles") == 1239);
  CHECK(value(play, "torn") == 51);
  CHECK(value(play, "area") == doctest::Approx(0.683).epsilon(2e-3));
}

TEST_CASE("lab: how it tears, a slit and its tips") {
  LabPlayer play = at_step(2);
  play.choose(1);
  play.run(0.5);
  CHECK_FALSE(play.done());  // nothing is cut
  const double area = value(play, "area"), energy = value(play, "energy");
  cut_row(play, 20, 14, 26);
  CHECK(value(play, "area") == area);
  CHECK(value(play, "energy") == doctest::Approx(energy).epsilon(1e-9));
  play.run(3);
  finish(play);
  CHECK(value(play, "torn") == 12);
  CHECK(value(play, "particles") == 41 * 41 + 12);
  play.next();
  play.predict("0.27");
  const double coarse = lower_F_max(play, 0.35, 0.2);
  finish(play);
  CHECK(coarse == doctest::Approx(0.29).epsilon(0.03));
}

TEST_CASE("lab: how it tears, a finer cloth" * doctest::test_suite("slow")) {
  LabPlayer play = at_step(4);
  play.predict("0.204");
  cut_row(play, 40, 28, 52);
  play.run(1.5);
  CHECK_FALSE(play.done());
  const double fine = lower_F_max(play, 0.24, 0.15);
  finish(play);
  CHECK(value(play, "torn") >= 60);
  CHECK(fine == doctest::Approx(0.29 / std::sqrt(2)).epsilon(0.04));
}

TEST_CASE("lab: how it tears, a piece that falls") {
  LabPlayer play = at_step(5);
  play.choose(2);
  play.run(0.5);
  cut_row(play, 12, 0, 30);
  play.run(1);
  CHECK_FALSE(play.done());  // it hangs on by a part of the row
  cut_row(play, 12, 30, 39);
  play.run(2);
  finish(play);
  CHECK(value(play, "particles") == 1640);
}

TEST_CASE("lab: how it tears, done wrongly") {
  LabPlayer play("17_how_it_tears");
  play.choose(2);
  play.set("F_max=0.6");
  play.run(5);
  CHECK_FALSE(play.done());  // it held
  play.set_up_again();
  play.run(5);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
  play.skip(), play.skip(), play.skip();
  play.predict("0.106");
  CHECK(lower_F_max(play, 0.2, 0.09) > 0);  // without a slit it tears at the force of the diagonals
  CHECK_FALSE(play.done());
  LabPlayer hanging = at_step(5);
  hanging.choose(1);
  hanging.set("tearing.mode=springs");
  cut_row(hanging, 12, 0, 39);
  hanging.run(2);
  CHECK_FALSE(hanging.done());  // it falls, but no particle has become two
}

}  // namespace tyglab::lab_tearing_test
