// The lab on a cloth that meets itself, played: as it asks, and otherwise.
#include <doctest/doctest.h>

#include <cstdint>

#include "app/session/observables.h"
#include "core/analysis/self_crossings.h"
#include "tests/app/lab_player.h"

namespace tyglab::lab_meeting_test {

using test::finish;
using test::LabPlayer;

void restart_with(LabPlayer& play, std::initializer_list<const char*> settings) {
  play.restart();
  for (const char* setting : settings) play.set(setting);
}

double value(LabPlayer& play, const char* name) {
  const auto known = observe(play.session(), name);
  REQUIRE(known.has_value());
  return *known;
}

std::int64_t crossings(LabPlayer& play) {
  return self_crossings(*play.session().simulation).pairs;
}

/// Runs to where the step stops the motion, and waits until the crossings are counted.
void run_and_count(LabPlayer& play) {
  play.run(10);
  play.count();
}

LabPlayer at_step(int step) {
  LabPlayer play("16_meeting");
  for (int k = 0; k < step; ++k) play.skip();
  return play;
}

TEST_CASE("lab: meeting itself, two layers") {
  LabPlayer play("16_meeting");
  play.predict("0.0028");
  play.run(4.1);
  CHECK_FALSE(play.done());  // no particle is picked
  play.session().picked = Pins::Site{10, 4};
  play.update();
  CHECK_FALSE(play.done());  // of the lower layer
  play.session().picked = Pins::Site{45, 4};
  play.update();
  finish(play);
  const double rests = value(play, "y");
  CHECK(rests == doctest::Approx(0.00286).epsilon(0.01));
  // Of pairs that share the weight of a particle: 4·k·s³/d² each.
  const double d = 0.003, s = d - rests;
  CHECK(0.0001 * 9.82 / (4 * 60 * s * s * s / (d * d)) == doctest::Approx(9).epsilon(0.2));
}

TEST_CASE("lab: meeting itself, nothing, a force and a bound") {
  LabPlayer play = at_step(1);
  play.choose(2);
  play.run(1);
  CHECK_FALSE(play.done());
  run_and_count(play);
  finish(play);
  CHECK(crossings(play) == 7552);
  play.next();
  play.choose(1);
  restart_with(play, {});
  run_and_count(play);
  CHECK_FALSE(play.done());  // the layers cross as before
  restart_with(play, {"self=repel"});
  run_and_count(play);
  finish(play);
  CHECK(crossings(play) == 149);
  CHECK(value(play, "held_back") == 0);
  play.next();
  play.choose(1);
  restart_with(play, {"self=guard", "thickness=0.0045"});
  run_and_count(play);
  CHECK_FALSE(play.done());  // another cloth
  restart_with(play, {"thickness=0.001"});
  run_and_count(play);
  finish(play);
  CHECK(crossings(play) == 0);
  CHECK(value(play, "held_back") == 26729);
  play.next();
  play.choose(2);
  restart_with(play, {"thickness=0.003"});
  play.run(2);
  CHECK_FALSE(play.done());
  restart_with(play, {"thickness=0.0045"});
  play.run(2);
  finish(play);
  CHECK(value(play, "held_back") == 327);
}

TEST_CASE("lab: meeting itself, the thickness that stops a fall") {
  LabPlayer play = at_step(5);
  play.predict("0.0034");
  for (const char* thickness : {"thickness=0.002", "thickness=0.004"}) {
    restart_with(play, {thickness});
    play.run(1.6);
    CHECK_FALSE(play.done());
  }
  restart_with(play, {"thickness=0.003"});
  play.run(1.6);
  CHECK(value(play, "held_back") == 3);
  restart_with(play, {"thickness=0.0035"});
  play.run(1.6);
  finish(play);
  CHECK(value(play, "held_back") == 0);
  CHECK(play.lab().record().answer == doctest::Approx(0.00325));
}

TEST_CASE("lab: meeting itself, where the guard has nothing to do") {
  LabPlayer play = at_step(6);
  play.choose(2);
  play.run(2);
  CHECK_FALSE(play.done());  // dt is what it was
  CHECK(value(play, "held_back") == 327);
  restart_with(play, {"dt=0.0005"});
  play.run(2);
  finish(play);
  play.next();
  play.choose(2);
  restart_with(play, {"self=repel", "dt=0.0004"});
  play.run(2);
  CHECK_FALSE(play.done());  // another motion
  CHECK(value(play, "apart") > 1e-3);
  restart_with(play, {"dt=0.0005"});
  play.run(2);
  finish(play);
  CHECK(value(play, "apart") == 0);
}

TEST_CASE("lab: meeting itself, with too large a step") {
  LabPlayer play = at_step(8);
  play.choose(2);
  play.set("self=repel");
  play.run(2);
  CHECK(play.session().simulation->divergence());
  CHECK_FALSE(play.done());
  play.set_up_again();
  run_and_count(play);
  finish(play);
  CHECK(value(play, "held_back") == 5813);
}

TEST_CASE("lab: meeting itself, friction") {
  LabPlayer play = at_step(9);
  play.run(6);
  finish(play);
  play.next();
  play.choose(1);
  restart_with(play, {"friction=0.25"});
  play.run(6);
  CHECK_FALSE(play.done());  // too little to drag the lower layer along
  CHECK(value(play, "apart") < 0.01);
  restart_with(play, {"friction=1"});
  play.run(6);
  finish(play);
}

TEST_CASE("lab: meeting itself, done wrongly") {
  LabPlayer play = at_step(1);
  play.choose(0);
  play.set("thickness=0.002");
  run_and_count(play);
  CHECK_FALSE(play.done());  // the thickness has no part in it, but it was not asked for
  play.set_up_again();
  run_and_count(play);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
  play.next();
  play.choose(0);
  play.set("self=repel");
  play.update();
  CHECK_FALSE(play.done());  // the motion was made before
  CHECK(play.card(0) == "Layers was cross at t = 1.600 s: restart");
  restart_with(play, {"dt=0.0005"});
  run_and_count(play);
  CHECK_FALSE(play.done());  // a shorter step
}

}  // namespace tyglab::lab_meeting_test
