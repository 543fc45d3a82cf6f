// The gallery of `tyglab verify`: that its cases hold, that each of them can fail, and how they are judged.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

#include "core/analysis/machine.h"
#include "core/analysis/reference.h"
#include "core/analysis/study_run.h"
#include "core/verify/gallery.h"
#include "core/verify/trial.h"

namespace tyglab::verify_test {

using verify::Case;
using verify::Conditions;
using verify::Outcome;
using verify::Trial;

/// All cases, side by side.
std::vector<Outcome> measure_all(const Conditions& conditions) {
  const std::vector<const Case*> cases = verify::all_cases();
  std::vector<Outcome> outcomes(cases.size());
  in_parallel(
      int(cases.size()), processors(),
      [&](int n) { outcomes[std::size_t(n)] = verify::measure(*cases[std::size_t(n)], conditions); }, [](int) {},
      [] { return false; });
  return outcomes;
}

TEST_CASE("every case of the gallery holds") {
  const std::vector<Outcome> outcomes = measure_all({});
  CHECK(outcomes.size() >= 20);
  for (const Outcome& outcome : outcomes) {
    CAPTURE(std::string(outcome.of->name));
    CAPTURE(outcome.exact);
    CAPTURE(outcome.measured);
    CAPTURE(outcome.error);
    CAPTURE(outcome.at);
    CAPTURE(outcome.problem);
    CHECK(outcome.ok());
    CHECK(outcome.comparisons > 0);
    CHECK(outcome.order.has_value() == (outcome.of->order_within > 0));
    CHECK(outcome.seconds > 0);
  }
}

TEST_CASE("no case holds where what is simulated is not what it says") {
  Conditions wrong;
  wrong.disturb = [](Preset& preset) {
    preset.g *= 1.05, preset.W *= 1.05;
    preset.k_s *= 1.1, preset.k *= 1.1, preset.B *= 1.2, preset.kappa_warp *= 1.05;
    preset.k_d = 1.2 * preset.k_d + 1e-4;
    if (preset.self == "guard") preset.self = "off";
    if (preset.tearing == "split") preset.tearing = "springs";
    for (Body& body : preset.bodies) {
      body.friction = 1.05 * body.friction + 0.02, body.restitution *= 0.95;
      body.r *= body.shape == Body::Shape::sphere && body.restitution > 0 ? 1.01 : 1;
      body.velocity *= 1.01, body.spin *= 1.01;
    }
  };
  for (const Outcome& outcome : measure_all(wrong)) {
    CAPTURE(std::string(outcome.of->name));
    CAPTURE(outcome.exact);
    CAPTURE(outcome.measured);
    CAPTURE(outcome.error);
    CHECK_FALSE(outcome.ok());
  }
}

TEST_CASE("every row of the gallery says what it is") {
  std::set<std::string_view> names;
  for (const Case* one : verify::all_cases()) {
    CAPTURE(std::string(one->name));
    CHECK(names.insert(one->name).second);
    CHECK(verify::find_case(one->name) == one);
    CHECK(one->name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos);
    for (const std::string_view text : {one->title, one->sentence, one->formula, one->source}) CHECK(text.size() > 4);
    CHECK(one->sentence.ends_with("."));
    CHECK(one->allowed > 0);
    CHECK(one->allowed <= 0.03);
  }
  CHECK(verify::find_case("nothing") == nullptr);
}

/// What a case with that measurement comes to.
Outcome judged(void (*measure)(Trial&), double order_within = 0) {
  const Case one{"one", "One", "It is.", "$1$", "Here.", "m", 0.01, order_within, measure};
  Outcome outcome = verify::measure(one);
  CHECK(outcome.of == &one);
  outcome.problem += outcome.ok() ? "" : " not ok";  // the case ends here
  outcome.of = nullptr;
  return outcome;
}

bool holds(void (*measure)(Trial&), double order_within = 0) {
  return judged(measure, order_within).problem.empty();
}

TEST_CASE("an error counts relative to what is exact, and the worst of several decides") {
  CHECK(verify::error_of(2, 2.1) == doctest::Approx(0.05));
  CHECK(verify::error_of(-2, -2.1) == doctest::Approx(0.05));
  CHECK(verify::error_of(0, -0.1) == doctest::Approx(0.1));
  CHECK(holds([](Trial& trial) { trial.compare(1, 1.009); }));
  CHECK_FALSE(holds([](Trial& trial) { trial.compare(1, 1.011); }));
  const Outcome worst = judged(
      [](Trial& trial) { trial.compare(1, 1.001, "a"), trial.compare(3, 2.94, "b"), trial.compare(5, 5.01, "c"); });
  CHECK(worst.at == "b");
  CHECK(worst.exact == 3);
  CHECK(worst.measured == 2.94);
  CHECK(worst.error == doctest::Approx(0.02));
  CHECK(worst.comparisons == 3);
  for (const bool first : {true, false}) {
    const Outcome unknown = first ? judged([](Trial& trial) { trial.compare(1, std::nan("")), trial.compare(1, 1); })
                                  : judged([](Trial& trial) { trial.compare(1, 1), trial.compare(1, std::nan("")); });
    CHECK(unknown.error == std::numeric_limits<double>::infinity());
    CHECK_FALSE(unknown.problem.empty());
  }
  CHECK_FALSE(holds([](Trial&) {}));
}

TEST_CASE("an order is held from both sides, and must be measured where one is expected") {
  CHECK(holds([](Trial& trial) { trial.compare(1, 1), trial.converges(2, {4e-2, 1e-2}); }, 0.1));
  CHECK_FALSE(holds([](Trial& trial) { trial.compare(1, 1), trial.converges(2, {3.5e-2, 1e-2}); }, 0.1));
  CHECK_FALSE(holds([](Trial& trial) { trial.compare(1, 1), trial.converges(2, {4.5e-2, 1e-2}); }, 0.1));
  CHECK_FALSE(holds([](Trial& trial) { trial.compare(1, 1), trial.converges(2, {4e-2, 0}); }, 0.1));
  CHECK_FALSE(holds([](Trial& trial) { trial.compare(1, 1); }, 0.1));
  const Outcome refined = judged(
      [](Trial& trial) {
        trial.refine(
            1, 2, {0.04, 0.02, 0.01}, [](double h) { return 2 + h; }, "first");
        trial.refine(
            2, 2, {0.04, 0.02, 0.01}, [](double h) { return 2 - h * h * (1 + h); }, "second");
      },
      0.1);
  REQUIRE(refined.order.has_value());
  CHECK(refined.problem.empty());
  CHECK(refined.order->of == "second");
  CHECK(refined.order->errors.size() == 3);
  CHECK(refined.error == doctest::Approx(0.005));
}

TEST_CASE("a motion that diverges fails its case with a reason, and one that is stopped ends") {
  const Case* fall = verify::find_case("hung_beads");
  REQUIRE(fall != nullptr);
  Conditions exploding;
  exploding.disturb = [](Preset& preset) { preset.k_s = 1e6; };
  const Outcome outcome = verify::measure(*fall, exploding);
  CHECK_FALSE(outcome.ok());
  CHECK(outcome.problem == "the motion diverged");
  CHECK_THROWS_AS(verify::measure(*fall, {[] { return true; }, {}}), Stopped);
}

TEST_CASE("bisection finds where a property ends") {
  CHECK(verify::bisect(1, 4, 1e9, [](double x) { return x * x < 5; }) == doctest::Approx(std::sqrt(5)).epsilon(1e-9));
}

}  // namespace tyglab::verify_test
