// The lab on bending rigidity, played: as it asks, and otherwise.
#include <doctest/doctest.h>

#include "app/session/observables.h"
#include "tests/app/lab_player.h"

namespace tyglab::lab_bend_test {

using test::finish;
using test::LabPlayer;

void restart_with(LabPlayer& play, std::initializer_list<const char*> settings) {
  for (const char* setting : settings) play.set(setting);
  play.restart();
}

double lowest(LabPlayer& play) {
  return *observe(play.session(), "lowest_y");
}

TEST_CASE("lab: does it bend?") {
  LabPlayer play("14_bend");
  play.choose(2);
  play.set("k_b=1000");
  play.set("dt=0.00005");
  play.run(4);
  CHECK_FALSE(play.done());  // these are other springs
  play.set_up_again();
  play.run(4);
  finish(play);
  CHECK(lowest(play) == doctest::Approx(0.117).epsilon(2e-3));

  play.next();
  play.choose(2);
  play.run(2);
  CHECK_FALSE(play.done());  // at its full weight
  play.set("g=1.2275");
  play.run(1);
  CHECK_FALSE(play.done());  // a part of the motion was made with it
  play.restart();
  play.run(8);
  finish(play);

  play.next();
  play.predict("0.2");
  play.run(4);
  CHECK_FALSE(play.done());  // B is what it was
  play.set("B=0.2");
  play.update();
  CHECK_FALSE(play.done());
  play.restart();
  play.run(4);
  finish(play);
  // The elastica at G = 1 drops by 0.12347 of its length, to which half a spacing is added behind the last particle.
  const double full = 0.5 - lowest(play), slope = 0.16, length = 0.4;
  CHECK((full + slope * 0.0125 / 2) / length == doctest::Approx(0.12347).epsilon(2e-3));

  play.next();
  play.predict("8");
  play.run(3);
  CHECK_FALSE(play.done());
  restart_with(play, {"g=1.2275"});
  play.run(4);
  finish(play);
  CHECK(full / (0.5 - lowest(play)) == doctest::Approx(7.9).epsilon(0.01));

  play.next();
  play.predict("2");
  play.run(1);
  const double with_twist = 0.3 - lowest(play);
  CHECK_FALSE(play.done());
  play.set("twist=0");
  play.run(3);
  finish(play);
  CHECK((0.3 - lowest(play)) / with_twist == doctest::Approx(2.1).epsilon(0.03));
}

TEST_CASE("lab: does it bend?, done wrongly") {
  LabPlayer play("14_bend");
  play.choose(0);
  play.set("B=0.02");
  play.run(3);
  CHECK_FALSE(play.done());  // rigidity holds it
  play.set_up_again();
  play.run(0.4);
  CHECK_FALSE(play.done());  // it has not come to rest
  play.pull(4, 32, {0.1, 0.05, 0}, 0.5);
  play.release();
  play.run(3);
  CHECK_FALSE(play.done());  // a hand has brought it down
  play.set_up_again();
  play.run(4);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());

  play.next();
  play.choose(1);
  restart_with(play, {"g=1.2275", "k_b=0"});
  play.run(6);
  CHECK_FALSE(play.done());  // no springs at all
  CHECK(play.card(4).starts_with("k_b was changed from 100 to 0 N/m"));
  play.skip();

  play.predict("0.02");
  restart_with(play, {"B=0.1"});
  play.run(4);
  CHECK_FALSE(play.done());  // half as stiff
  restart_with(play, {"B=0.2", "g=4.91"});
  play.run(4);
  CHECK_FALSE(play.done());  // half as heavy
  restart_with(play, {"g=9.82"});
  play.run(4);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());

  play.next();
  play.predict("2");
  restart_with(play, {"g=1.2275", "B=0.4", "dt=0.00002"});
  play.run(4);
  CHECK_FALSE(play.done());  // another rigidity
  play.skip();

  play.predict("1");
  play.set("B=0.0015");
  play.run(3);
  CHECK_FALSE(play.done());  // a softer cloth sinks as far
  play.set_up_again();
  play.set("twist=0.5");
  play.run(3);
  CHECK_FALSE(play.done());
  play.set("twist=0");
  play.run(3);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
}

}  // namespace tyglab::lab_bend_test
