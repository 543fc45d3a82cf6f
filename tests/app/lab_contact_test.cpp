// The lab on the time of contact, played: as it asks, and otherwise.
#include <doctest/doctest.h>

#include <cmath>

#include "app/session/observables.h"
#include "tests/app/lab_player.h"

namespace tyglab::lab_contact_test {

using test::finish;
using test::LabPlayer;

void restart_with(LabPlayer& play, std::initializer_list<const char*> settings) {
  for (const char* setting : settings) play.set(setting);
  play.restart();
}

double energy(LabPlayer& play) {
  return *observe(play.session(), "energy");
}

constexpr double start = 0.491, e = 0.8;  // J

TEST_CASE("lab: when does it hit?, bounces") {
  LabPlayer play("15_contact");
  play.predict("0.131");
  play.run(1);
  CHECK_FALSE(play.done());
  play.run(2);
  CHECK(play.session().simulation->time() == doctest::Approx(1.4));  // it stopped by itself
  finish(play);
  CHECK(energy(play) / (start * std::pow(e, 6)) == doctest::Approx(1).epsilon(1e-4));

  play.next();
  play.choose(2);
  play.restart();
  play.run(2);
  CHECK_FALSE(play.done());  // contact is what it was
  restart_with(play, {"contact=step"});
  play.run(2);
  finish(play);
  const double coarse = energy(play) / (start * std::pow(e, 6)) - 1;
  CHECK(coarse == doctest::Approx(0.142).epsilon(5e-3));

  play.next();
  play.predict("7");
  play.restart();
  play.run(2);
  CHECK_FALSE(play.done());
  restart_with(play, {"dt=0.002"});
  play.run(2);
  finish(play);
  const double fine = energy(play) / (start * std::pow(e, 6)) - 1;
  CHECK(coarse / fine == doctest::Approx(2).epsilon(0.05));

  play.next();
  play.predict("2.87");
  play.run(2.8);
  CHECK_FALSE(play.done());
  play.run(1);
  finish(play);
  // The last bounces, shorter than a step, are left out.
  const double series = std::sqrt(2 * 0.5 / 9.82) * (1 + e) / (1 - e), rested = 0.1;
  const double end = play.session().simulation->time() - rested;
  CHECK(end < series);
  CHECK(end > series - 0.004 / (1 - e) * 1.5);
}

TEST_CASE("lab: when does it hit?, the order of an impact" * doctest::test_suite("slow")) {
  LabPlayer play("15_contact");
  for (int step = 0; step < 4; ++step) play.skip();
  play.look();
  CHECK_FALSE(play.done());  // at the dt with which it opens
  const double coarse = *observe(play.session(), "error");
  play.set("dt=0.002");
  play.look();
  finish(play);
  const double at_end = *observe(play.session(), "error");
  CHECK(coarse / at_end == doctest::Approx(2).epsilon(0.05));
  play.next();
  play.choose(2);
  play.look();
  CHECK_FALSE(play.done());
  play.set("contact=local");
  play.look();
  finish(play);
  const double met = *observe(play.session(), "error");
  CHECK(at_end / met > 20);
  play.next();
  play.predict("4");
  play.set("dt=0.001");
  play.set("contact=step");
  play.look();
  CHECK_FALSE(play.done());
  play.set("contact=local");
  play.look();
  finish(play);
  CHECK(met / *observe(play.session(), "error") == doctest::Approx(4).epsilon(0.1));
}

TEST_CASE("lab: when does it hit?, too fast for its step") {
  LabPlayer play("15_contact");
  for (int step = 0; step < 7; ++step) play.skip();
  play.choose(2);
  restart_with(play, {"contact=local"});
  play.run(1);
  CHECK_FALSE(play.done());  // it stops on the ball
  restart_with(play, {"contact=step", "dt=0.004"});
  play.run(1);
  CHECK_FALSE(play.done());  // it stops above the ball
  CHECK(*observe(play.session(), "lowest_y") > 0.5);
  restart_with(play, {"dt=0.01"});
  play.run(1);
  finish(play);
  play.next();
  play.predict("0.4");
  restart_with(play, {"dt=0.002"});
  play.run(1);
  CHECK_FALSE(play.done());  // with shorter steps it stops in its way too
  restart_with(play, {"contact=local", "dt=0.01"});
  play.run(1);
  finish(play);
  CHECK(*observe(play.session(), "lowest_y") == doctest::Approx(0.378).epsilon(5e-3));
}

TEST_CASE("lab: when does it hit?, done wrongly") {
  LabPlayer play("15_contact");
  play.predict("0.256");
  restart_with(play, {"bodies[0].restitution=0.9"});
  play.run(2);
  CHECK_FALSE(play.done());  // another ball
  play.set_up_again();
  play.run(2);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());

  play.next();
  play.choose(1);
  play.run(0.1);
  play.set("contact=step");
  play.update();
  CHECK_FALSE(play.done());  // the bounces were made before
  CHECK(play.card(0) == "Contact was when met at t = 1.400 s: restart");
  restart_with(play, {"dt=0.001"});
  play.run(2);
  CHECK_FALSE(play.done());  // with a shorter step it gains less
  restart_with(play, {"dt=0.004"});
  play.run(2);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());

  play.next();
  play.predict("14");
  restart_with(play, {"dt=0.002", "contact=local"});
  play.run(2);
  CHECK_FALSE(play.done());  // without an error
  play.skip();
  play.predict("2.9");
  restart_with(play, {"contact=step"});
  play.run(4);
  CHECK_FALSE(play.done());  // it never quite rests
}

}  // namespace tyglab::lab_contact_test
