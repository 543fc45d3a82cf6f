// Every shipped lab, played as a hasty, lazy or mistaken student would: what was not done does not count.
#include <doctest/doctest.h>

#include "app/session/observables.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "tests/app/desk.h"
#include "tests/app/lab_player.h"

namespace tyglab::lab_hasty_test {

using test::finish;
using test::LabPlayer;

/// What the checks of a step ask of constants, as settings: "k_s=800".
std::vector<std::string> asked_constants(const LabStep& step) {
  std::vector<std::string> settings;
  for (const Condition& check : step.checks) {
    if (check.span == Span::narrowed) continue;  // no value is asked for
    const bool constant = find_row(check.name) != nullptr;
    if (is_word(check.name)) {
      if (constant || check.name == "engine" || check.name == "precision")
        settings.push_back(check.name + "=" + check.right.word);
    } else if (constant && check.right.name.empty()) {
      const bool below = check.relation == Relation::less, above = check.relation == Relation::greater;
      settings.push_back(check.name + "=" + std::to_string(check.right.factor * (below ? 0.99 : above ? 1.01 : 1)));
    }
  }
  return settings;
}

void predict_wrongly(LabPlayer& play) {
  const auto& asked = play.lab().now().prediction;
  if (!asked) return;
  asked->choices.empty() ? play.predict("12345") : play.choose(asked->right == 0 ? 1 : 0);
}

/// Opens the step, predicts wrongly, lets it run, and types what the checks ask for only then.
void play_lazily(LabPlayer& play) {
  const LabStep& step = play.lab().now();
  for (int n = 0; n < 3; ++n) play.update();
  CHECK_FALSE(play.done());  // by being opened
  predict_wrongly(play);
  play.update();
  CHECK_FALSE(play.done());  // by a prediction
  play.run(2.2);
  if (play.done()) {  // its constants are right from the beginning, so that running it is what is asked for
    if (step.prediction) CHECK_FALSE(play.right());
    return;
  }
  const Preset before = play.session().preset();
  for (const std::string& setting : asked_constants(step))  // one of them may be refused, which changes nothing
    apply_edit(play.session(), edit::Change{with_settings(play.session().preset(), {setting})});
  if (play.session().preset() == before) return;
  for (int n = 0; n < 3; ++n) play.update();
  CHECK_FALSE(play.done());  // by constants that are typed after the motion
}

TEST_CASE("no step of any lab is completed by opening it, or by constants typed after the motion" *
          doctest::test_suite("slow")) {
  Session session;
  for (const Lab& lab : find_labs(session)) {
    LabPlayer play(lab.label);
    for (std::size_t k = 0; k < lab.steps.size(); ++k) {
      CAPTURE(lab.label);
      CAPTURE(lab.steps[k].title);
      if (k > 0) play.skip();
      if (!lab.steps[k].checks.empty() && !lab.steps[k].needs_opencl) play_lazily(play);
    }
  }
}

TEST_CASE("lab: k_s and the critical time step, done wrongly") {
  LabPlayer play("03_stiffness");
  play.predict("133");
  play.set("k_s=150");
  play.set("dt=0.0015");
  play.run(2);
  CHECK(play.session().simulation->divergence());
  play.set("dt=0.001");
  play.set("k_s=195");
  play.update();
  CHECK_FALSE(play.done());  // another dt made it explode
  play.restart();
  play.run(5);
  play.set("k_s=187");
  play.restart();
  play.run(0.6);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
  play.next();
  play.choose(1);
  play.set("k_s=400");
  play.set("dt=0.0005");
  play.run(3);
  CHECK_FALSE(play.done());  // a smaller step is no proof
  CHECK(play.card(3).starts_with("dt was changed from 0.001 to 5e-4 s at t = "));
  play.restart();
  play.set("dt=0.001");
  play.set("k_s=180");
  play.run(1.9);
  CHECK_FALSE(play.done());  // two seconds have not passed
  play.run(0.2);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
  play.next();
  play.predict("1");
  play.set("k_s=800");
  play.set("dt=1");
  play.run(1);
  CHECK_FALSE(play.session().simulation->divergence());
  CHECK_FALSE(play.done());  // a single step that tears the sheet apart is not yet called an explosion
}

TEST_CASE("a prediction after constants were changed is marked, and counts neither way") {
  LabPlayer play("03_stiffness");
  play.set("mode=2");
  play.update();
  CHECK_FALSE(play.lab().record().looked);
  play.set("k_s=195");  // the gauge shows another limit
  play.update();
  play.set("k_s=50");
  play.update();
  play.set_up_again();
  CHECK(play.lab().record().looked);
  play.predict("200");
  play.set("k_s=188");
  play.run(0.6);
  play.set("k_s=195");
  play.run(5);
  REQUIRE(play.done());
  CHECK(lab_result(play.lab(), 1).ends_with("” with 1 of 3 steps done. Ctrl+L lists all labs."));
  play.next();
  play.choose(0);
  play.set("k_s=190");
  play.update();
  CHECK_FALSE(play.lab().record().looked);  // that was after the prediction
}

TEST_CASE("lab: an explosion that a k_s beyond the limit began does not count below it") {
  LabPlayer play("03_stiffness");
  play.predict("200");
  play.set("k_s=300");
  play.run(0.012);
  play.set("k_s=190");
  play.run(3);
  REQUIRE(play.session().simulation->divergence());
  CHECK_FALSE(play.done());
  CHECK(play.card(1).starts_with("k_s was 300 N/m at t = "));
}

TEST_CASE("lab: what damping does to the limit, done wrongly") {
  LabPlayer play("04_damping");
  play.choose(0);
  play.set("k_s=400");
  play.run(2);
  CHECK(play.session().simulation->divergence());
  play.set("k_s=50");
  play.update();
  CHECK_FALSE(play.done());  // stiffness made it explode
  play.restart();
  play.set("k_d=0.1");
  play.run(2);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
  play.next();
  play.skip();
  play.choose(1);
  play.set("integrator=verlet");
  play.run(0.6);
  play.set("integrator=implicit_euler");
  play.set("k_d=0.5");
  play.update();
  CHECK_FALSE(play.done());  // Verlet made the motion
  CHECK(play.card(0).starts_with("Integrator was Verlet at t = "));
}

TEST_CASE("lab: order of convergence, done hastily" * doctest::test_suite("slow")) {
  LabPlayer play("05_order");
  play.set("dt=0.0005");
  play.run(0.1);
  play.look();
  CHECK_FALSE(play.done());  // the lab measures from t = 0 on
  play.restart();
  play.update();
  CHECK_FALSE(play.done());  // the error is that of another moment
  play.look();
  finish(play);
  play.next();
  play.predict("2");
  play.set("dt=0.00025");
  play.update();
  CHECK_FALSE(play.done());  // nothing has been measured for this dt
  play.set("integrator=rk4");
  play.look();
  CHECK_FALSE(play.done());  // another method
  play.set("integrator=verlet");
  play.run(0.1);
  play.look();
  CHECK_FALSE(play.done());  // another moment
  play.restart();
  play.look();
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
}

TEST_CASE("lab: float against double, done hastily") {
  LabPlayer play("06_float");
  play.run(0.2);
  play.set("dt=0.001");
  play.run(1);
  CHECK_FALSE(play.done());
  play.set("dt=0.0005");
  play.update();
  CHECK_FALSE(play.done());  // a part of the motion was made with another dt
  play.set_up_again();
  play.run(1);
  finish(play);
  play.next();
  play.run(1);  // before the prediction
  play.run(0.2);
  play.choose(1);
  play.update();
  CHECK_FALSE(play.done());  // the two cloths are seen at different moments
  play.restart();
  play.run(1);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
  play.next();
  play.choose(0);
  play.pull(12, 12, {0.5, 1, 0.5}, 0.1);
  play.release();
  play.run(1);
  CHECK_FALSE(play.done());  // a hand took it there
  CHECK(play.card(4).starts_with("The cloth was held by hand at t = "));
}

TEST_CASE("lab: chaos, done wrongly" * doctest::test_suite("slow")) {
  LabPlayer play("08_chaos");
  play.run(4);
  finish(play);
  play.next();
  play.choose(0);
  play.set("k_s=60");
  play.run(4);
  CHECK_FALSE(play.done());  // that is no small difference
  play.set_up_again();
  play.pull(31, 15, {0.2, 0, 0.3}, 0.2);
  play.release();
  play.run(4);
  CHECK_FALSE(play.done());
  play.set_up_again();
  play.run(4);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
}

TEST_CASE("lab: tearing, done wrongly" * doctest::test_suite("slow")) {
  LabPlayer play("09_tearing");
  play.predict("0.115");
  play.run(30);
  finish(play);
  play.set("F_max=0.02");
  play.session().pacing.playing = true;
  for (int n = 0; n < 12; ++n) play.update(1.0 / 60);  // the step is done, and the motion goes on
  play.session().pacing.playing = false;
  CHECK(*observe(play.session(), "torn") >= 100);
  play.set("F_max=0.08");
  play.next();
  play.predict("0.08");
  play.run(0.1);
  CHECK_FALSE(play.done());  // it tore before the step began
  CHECK(play.card(0).ends_with(" · neither found yet"));
  play.restart();
  play.set("F_max=0");
  play.run(2.5);
  play.set("F_max=0.02");
  play.run(0.2);
  CHECK(*observe(play.session(), "torn") >= 100);
  play.set("F_max=0.08");
  play.run(0.2);
  CHECK_FALSE(play.done());  // it tore at another F_max
  CHECK(play.card(0).ends_with(" · at 0.02 N; find a value near it at which it does not"));
  play.set("F_max=0.085");
  play.restart();
  play.run(3);
  CHECK(*observe(play.session(), "torn") >= 100);
  CHECK_FALSE(play.done());  // the fall tore it
  CHECK(play.card(0).ends_with(" · at 0.02 N; find a value near it at which it does not"));
  play.restart();
  play.set("F_max=0");
  play.run(2.5);
  for (double F_max = 0.12; !play.done() && F_max > 0.05; F_max -= 0.002) {
    play.set("F_max=" + std::to_string(F_max));
    play.run(1.1);
  }
  finish(play);
}

TEST_CASE("lab: kinks, compared with another motion" * doctest::test_suite("slow")) {
  LabPlayer play("05_order");
  for (int step = 0; step < 4; ++step) play.skip();
  play.run(1);
  play.look();
  finish(play);
  play.next();
  play.choose(1);
  play.set("integrator=verlet");
  play.restart();
  play.run(1);
  play.set("integrator=rk4");
  play.set("dt=0.0005");
  play.look();
  CHECK(play.session().simulation->time() == doctest::Approx(0.5));
  CHECK_FALSE(play.done());  // the error of another state, to which Verlet has led
}

TEST_CASE("lab: wind, done by hand") {
  LabPlayer play("12_wind");
  play.skip();
  play.skip();
  play.predict("0.4");
  play.set("gust_period=1.6");
  play.run(0.2);
  play.pull(31, 16, {0, 1, 1}, 1);
  play.run(1);
  CHECK_FALSE(play.done());  // a hand has lifted it, not the wind
  play.release();
  play.restart();
  play.set("W=[0,0,0.004]");
  play.run(3);
  CHECK_FALSE(play.done());  // a storm
}

TEST_CASE("lab: bending, the steps in another order") {
  LabPlayer play("11_bending");
  play.skip();
  play.skip();
  play.choose(0);
  play.set("k_b=1000");
  play.set("k_s=600");
  play.run(6);
  CHECK_FALSE(play.done());  // both were raised
  play.set_up_again();
  play.set("k_b=1000");
  play.run(10);
  REQUIRE(play.done());
  CHECK_FALSE(play.right());
  back_step(play.session());
  play.choose(1);
  play.run(0);
  CHECK_FALSE(play.done());  // what is open belongs to the step after it
  play.set_up_again();
  play.run(10);
  finish(play);
}

TEST_CASE("lab: Hooke's law, Euler and OpenCL done wrongly") {
  LabPlayer hooke("01_hooke");
  hooke.predict("0.05");
  hooke.set("g=4.91");
  hooke.set("k=5");
  hooke.run(10);
  CHECK_FALSE(hooke.done());  // half the weight on half the spring rests there too
  hooke.set_up_again();
  hooke.run(10);
  REQUIRE(hooke.done());
  CHECK_FALSE(hooke.right());

  LabPlayer euler("02_euler");
  euler.predict("2.7");
  euler.run(0.4);
  euler.set("dt=0.005");
  euler.run(1);
  CHECK_FALSE(euler.done());
  euler.set("dt=0.01");
  euler.restart();
  euler.run(2);
  finish(euler);
  euler.skip();
  euler.skip();
  euler.choose(0);
  euler.run(5);
  euler.set("integrator=euler");
  euler.run(0.5);
  euler.set("integrator=verlet");
  euler.run(10);
  CHECK_FALSE(euler.done());  // Euler has added to it

  LabPlayer opencl("10_opencl");
  opencl.set("precision=double");
  opencl.run(0.1);
  opencl.set("precision=float");
  opencl.run(1);
  CHECK_FALSE(opencl.done());  // half of it was made in double
}

}  // namespace tyglab::lab_hasty_test
