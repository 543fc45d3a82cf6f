// What a lab's card says of its checks: plain sentences, and no answer before it has been found.
#include <doctest/doctest.h>

#include <cmath>

#include "app/base/text.h"
#include "app/session/observables.h"
#include "core/model/words.h"
#include "tests/app/lab_player.h"

namespace tyglab::lab_words_test {

using test::LabPlayer;

bool says(const std::string& text, std::string_view what) {
  return text.find(what) != std::string::npos;
}

/// Of a second step with that line.
Condition check(const std::string& line) {
  const Lab lab = parse_lab("# A lab\n\n## One\n\nText.\n\n## Two\n\nText.\n\n```lab\n" + line + "\n```\n", "my.md");
  return lab.steps[1].checks[0];
}

TEST_CASE("a check says in plain words what it compares with the step before") {
  CHECK(words_of(check("check: t = before.t")) == "t as in the previous lab step");
  CHECK(words_of(check("check: dt = 0.5 * before.dt")) == "dt half as large as in the previous lab step");
  CHECK(words_of(check("check: dt = 2 * before.dt")) == "dt twice as large as in the previous lab step");
  CHECK(words_of(check("check: error < 0.3 * before.error")) == "error < 0.3 × its value in the previous lab step");
  CHECK(words_of(check("check: F < before.F_g")) == "F < F_g in the previous lab step");
  CHECK(words_of(check("check: apart = 0 m")) == "Each particle where it was in the previous lab step");
  CHECK(words_of(check("check: apart > 0.1 m")) == "Distance from the cloth of the previous lab step > 0.1 m");
}

TEST_CASE("what is yes or no is asked in a sentence") {
  CHECK(words_of(check("check: diverged = no")) == "The simulation does not diverge");
  CHECK(words_of(check("check: diverged != no")) == "The simulation diverges");
  CHECK(words_of(check("check: playing = no")) == "The motion is paused");
  CHECK(words_of(check("check: picked = yes")) == "A particle is picked");
}

TEST_CASE("a choice among the constants is called as in the window") {
  CHECK(words_of(check("check: contact = step throughout")) == "Contact: at end of step throughout");
  CHECK(words_of(check("check: self = off")) == "Layers: cross");
  CHECK(words_of(check("check: tearing.mode != split")) == "Overload: not cloth parts");
}

TEST_CASE("what is to be found out is not told by the check") {
  CHECK(check("find: k_s > 185").to_find);
  CHECK_FALSE(check("check: k_s > 185").to_find);
  CHECK(subject_of(check("find: energy > 0.52 J")) == "The value of the energy");
  CHECK(subject_of(check("find: k_s > 185 when diverged = yes")) == "The value of k_s when the cloth diverges");
  CHECK(subject_of(check("find: diverged = no")) == "Diverged?");
  CHECK(subject_of(check("find: integrator = euler")) == "Integrator");
  CHECK(subject_of(check("find: apart > 0.1 m")) == "Distance from the cloth of the previous lab step");
  CHECK(found_together(check("find: energy > 1 J"), check("find: energy < 2 J")));
  CHECK_FALSE(found_together(check("find: energy > 1 J"), check("check: energy < 2 J")));
  CHECK_FALSE(found_together(check("find: energy > 1 J"), check("find: kinetic < 2 J")));
  CHECK_FALSE(found_together(check("find: energy > 1 J"), check("find: energy < 2 J once")));
}

TEST_CASE("the card says what is now, and of what is to be found no more than the way to it") {
  LabPlayer play("03_stiffness");
  play.predict("200");
  play.update();
  const std::string narrowed =
      "k_s to within 5 %: find a value at which the cloth diverges, and one at which it does not in 0.5 s · ";
  CHECK(play.card(0) == narrowed + "neither found yet");
  CHECK(play.card(2) == "Integrator: Verlet so far");
  play.set("k_s=300");
  play.update();
  CHECK(play.card(1) == "The value of k_s throughout · now 300 N/m, too high (Springs)");
  play.run(1);
  CHECK(play.card(1) == "k_s was 300 N/m at t = 0.016 s: lower it, then restart");
  play.set("k_s=195");
  play.update();
  CHECK(play.card(1) == "k_s was 300 N/m at t = 0.016 s: restart");
  CHECK(play.session().simulation->divergence());
  CHECK(play.card(0) == narrowed + "at 300 N/m; find a value near it at which it does not");
  play.set("k_s=180");
  play.restart();
  play.run(0.6);
  CHECK(play.card(0) == narrowed + "at 300 N/m, not at 180 N/m: find closer values");
  play.skip();
  play.choose(1);
  play.set("k_s=300");
  play.run(1);
  CHECK(play.card(2) == "Diverged? Yes");
}

TEST_CASE("what was changed before the first step is told at t = 0, and no result is to be set") {
  LabPlayer play("02_euler");
  play.skip();
  play.skip();
  play.choose(2);
  play.set("dt=0.264");
  play.run(3);
  REQUIRE(play.session().simulation->divergence());
  CHECK(play.card(1) ==
        "dt was changed from 0.01 to 0.264 s at t = 0.000 s: restart, and change only what the task names");
  CHECK(
      says(play.card(2), " · now " + time_number(play.session().simulation->divergence()->t, 0.264) + " s (top bar)"));
  CHECK(says(play.card(3), "energy was "));
  CHECK(play.card(3).ends_with(" s: restart"));
}

TEST_CASE("what a check compares with is told with its value in the previous lab step") {
  LabPlayer play("06_float");
  play.run(1);
  play.next();
  play.choose(0);
  play.update();
  CHECK(says(play.card(0), "t as in the previous lab step, that is 0.5 s · now 0 s"));
  CHECK(says(play.card(1), "Distance from the cloth of the previous lab step · now "));
}

TEST_CASE("no bound of what is to be found stands on a lab's card before it is found") {
  Session session;
  for (const Lab& lab : find_labs(session)) {
    LabPlayer play(lab.label);
    for (std::size_t k = 0; k < lab.steps.size(); ++k) {
      if (k > 0) play.skip();
      for (std::size_t n = 0; n < lab.steps[k].checks.size(); ++n) {
        const Condition& now = lab.steps[k].checks[n];
        if (!now.to_find) continue;
        CAPTURE(lab.label);
        CAPTURE(words_of(now));
        CHECK_FALSE(says(play.card(n), words_of(now)));
        if (!is_word(now.name) && now.right.factor != 0)
          CHECK_FALSE(says(play.card(n), " " + shortest_number(now.right.factor) + " "));
      }
    }
  }
}

TEST_CASE("where a number is predicted no check on the card encloses it") {
  Session session;
  for (const Lab& lab : find_labs(session))
    for (const LabStep& step : lab.steps) {
      if (!step.prediction || !step.prediction->choices.empty() || !step.prediction->answer.name.empty()) continue;
      CAPTURE(lab.label);
      CAPTURE(step.title);
      for (const Condition& one : step.checks)
        if (!one.to_find && unit_of(one.name) == step.prediction->unit && one.right.name.empty() &&
            one.relation != Relation::equal)
          CHECK(std::abs(one.right.factor / step.prediction->answer.factor - 1) > 0.2);
    }
}

}  // namespace tyglab::lab_words_test
