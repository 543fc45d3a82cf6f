// The lab on stiffness and strong damping, played: as it asks, and otherwise.
#include <doctest/doctest.h>

#include "app/session/observables.h"
#include "tests/app/lab_player.h"

namespace tyglab::lab_stiff_test {

using test::finish;
using test::LabPlayer;

void restart_with(LabPlayer& play, std::initializer_list<const char*> settings) {
  for (const char* setting : settings) play.set(setting);
  play.restart();
}

TEST_CASE("lab: too stiff, too damped" * doctest::test_suite("slow")) {
  LabPlayer play("13_stiff");
  play.predict("0.00014");
  restart_with(play, {"dt=0.0001"});
  play.run(0.6);
  CHECK_FALSE(play.done());  // smaller than it need be
  play.set("dt=0.00014");
  play.run(0.6);
  CHECK_FALSE(play.done());  // the first part was made with the smaller step
  play.restart();
  play.run(0.6);
  finish(play);
  CHECK(*observe(play.session(), "dt_crit") == doctest::Approx(0.000141).epsilon(2e-3));

  play.next();
  play.choose(2);
  play.run(1);
  finish(play);

  play.next();
  play.choose(0);
  play.run(1.1);
  CHECK_FALSE(play.done());  // Verlet itself
  restart_with(play, {"integrator=damped_verlet"});
  play.run(1.1);
  CHECK_FALSE(play.done());  // at the small dt
  restart_with(play, {"dt=0.001"});
  play.run(1.1);
  finish(play);

  play.next();
  play.choose(1);
  play.run(1);
  finish(play);

  play.next();
  play.predict("10");
  restart_with(play, {"integrator=rkc2"});
  play.run(0.5);
  CHECK_FALSE(play.done());  // a second has not passed
  play.run(0.6);
  finish(play);

  play.next();
  play.run(1);
  CHECK(play.session().simulation->time() == doctest::Approx(0.5));  // it stopped by itself
  CHECK(play.done());
  play.next();
  play.choose(1);
  restart_with(play, {"dt=0.02"});
  play.run(1);
  finish(play);
  play.next();
  play.choose(1);
  restart_with(play, {"integrator=vbd"});
  play.run(1);
  CHECK_FALSE(play.done());  // another method
  restart_with(play, {"integrator=projective_dynamics", "iterations=100"});
  play.run(1);
  CHECK_FALSE(play.done());  // other passes
  restart_with(play, {"iterations=10"});
  play.run(1);
  finish(play);
}

TEST_CASE("lab: what makes a damped cloth explode is its own damping, and no other change") {
  LabPlayer play("13_stiff");
  play.skip();
  play.choose(1);
  play.set("k_s=5000");
  play.run(1);
  CHECK_FALSE(play.done());
  play.set_up_again();
  play.run(1);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
}

}  // namespace tyglab::lab_stiff_test
