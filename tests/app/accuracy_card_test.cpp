// What the cards of accuracy and stability say and draw.
#include "app/ui/cards/cards.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/integrators/scheme.h"
#include "core/theory/advice.h"
#include "tests/support/scenes.h"

namespace tyglab::accuracy_card_test {

AccuracyStudy study_of(const Preset& preset) {
  AccuracyStudy study;
  study.of = preset;
  study.reference.seconds = 0.25, study.reference.agreement_rms_m = 1e-9;
  return study;
}

ErrorPoint point(const char* method, double error, double cost, bool told = true) {
  return {method, Precision::float_, 0.001, 0, error, cost, told};
}

TEST_CASE("the accuracy card says what is known, and why where nothing is") {
  AccuracyStudy study = study_of(test::cloth(8, 8, "verlet"));
  study.present = point("verlet", 2.13e-5, 0.0123);
  CHECK(accuracy_words(study) ==
        "Verlet's error is 21 µm (rms) over the next 0.25 s from t = 0.000 s; it takes 0.012 s of CPU time per "
        "simulated "
        "second.");
  study.present = point("verlet", 2e-9, 0.0123, false);
  CHECK(accuracy_words(study).find("error is below 10 nm") != std::string::npos);
  study.present = point("verlet", std::numeric_limits<double>::infinity(), 0.0123);
  CHECK(accuracy_words(study).find("Verlet diverges") != std::string::npos);
  CHECK(accuracy_time(study) == "over the next 0.25 s");
  study.problem = "it cannot be followed";
  CHECK(accuracy_words(study).find("it cannot be followed") != std::string::npos);
}

TEST_CASE(
    "while nothing is known yet the accuracy card says what is measured, how much is done and how long it takes") {
  AccuracyStudy study;
  study.of = test::cloth(8, 8, "verlet");
  study.of.dt = 0.001;
  CHECK(measuring_words(study, 0) ==
        "Measuring the error of Verlet at dt = 0.001 s. First come two fine runs for comparison: 0 % done; this "
        "usually takes a few seconds.");
  study.reference.seconds = 0.25, study.reference_part = 0.25;
  CHECK(measuring_words(study, 1.5) ==
        "Measuring the error of Verlet at dt = 0.001 s over the next 0.25 s. First come two fine runs for comparison: "
        "25 % done, about 5 s left.");
  CHECK(measuring_words(study, 0.1).find("less than 1 s left") != std::string::npos);
  study.reference_part = 1;
  CHECK(measuring_words(study, 3).find("the run with these settings follows") != std::string::npos);
  CHECK(other_methods_words(study).empty());
  study.present = point("verlet", 1e-4, 0.1);
  study.methods_done = 2;
  CHECK(other_methods_words(study) == " Other methods: 2 of 6 measured.");
  study.done = true;
  CHECK(other_methods_words(study).empty());
}

TEST_CASE("the accuracy card says over which time its error is, and why that is short") {
  AccuracyStudy study = study_of(test::cloth(128, 128, "verlet"));
  CHECK(accuracy_time(study).empty());
  study.present = point("verlet", 2.13e-5, 0.0123);
  CHECK(accuracy_words(study).find("would take too long") == std::string::npos);
  study.reference.seconds = 0.042;
  CHECK(accuracy_time(study) == "over the next 0.042 s");
  CHECK(accuracy_words(study).find("fine runs of 128 × 128 particles would take too long") != std::string::npos);
}

TEST_CASE("its chart reaches the error that settings are looked for") {
  AccuracyStudy study = study_of(test::cloth(8, 8, "verlet"));
  study.points = {point("verlet", 1e-3, 0.1), point("verlet", 1e-4, 0.2)};
  CHECK(accuracy_chart(Tokens{}, study).series.size() == 1);
  const Chart chart = accuracy_chart(Tokens{}, study, 1e-7);
  REQUIRE(chart.series.size() == 2);
  CHECK(chart.series[1].name == "target");
  CHECK(chart.series[1].x == std::vector<double>{0.1, 0.2});
  CHECK(chart.series[1].y == std::vector<double>{1e-7, 1e-7});
}

SettingsSearch finished_search() {
  SettingsSearch search;
  search.of = test::cloth(8, 8, "verlet");
  search.seconds = 1, search.agreement_rms_m = 1e-6, search.references = "rk4", search.done = true;
  search.methods = search.methods_done = 8;
  search.points = {point("verlet", 1e-4, 0.1)};
  return search;
}

TEST_CASE("the finder says how far it is, what it found, and what can be promised where it refuses") {
  SettingsSearch search = finished_search();
  search.of = test::cloth(8, 8, "euler");
  search.of.dt = 0.001;
  const auto words = [&](double tolerance) { return finder_words(search, tolerance, search.of); };
  CHECK(words(1e-3).find("over the 1 s from t = 0 s") != std::string::npos);
  CHECK(words(1e-3).find("whole second") == std::string::npos);
  CHECK(words(1e-5).find("The tightest tolerance that can be guaranteed is 2e-4 m.") != std::string::npos);
  CHECK(words(1e-6).find("differ by 1e-6 m") != std::string::npos);
  search.present = point("euler", 3e-3, 0.2);
  CHECK(words(1e-3).find(" Now: error 0.003 m") != std::string::npos);
  Preset other = search.of;
  other.integrator = "rk4";  // once another setting is used, the one measured at first is the present one no more
  CHECK(finder_words(search, 1e-3, other).find(" Before, with Euler and dt = 0.001 s: error 0.003 m") !=
        std::string::npos);
  search.seconds = 0.4;
  CHECK(words(1e-3).find("whole second") != std::string::npos);
  search.done = false, search.methods_done = 3;
  const std::string tried = std::to_string(search.points.size()) + " settings tried.";
  CHECK(words(1e-3) == "Trying methods: 3 of 8 done, " + tried);
  CHECK(finder_words(search, 1e-3, search.of, true) == "Stopped after 3 of 8 methods, " + tried);
  search.methods = 0, search.reference_part = 0.25;
  CHECK(words(1e-3) == "First come fine runs for comparison, from t = 0 s: 25 % done.");
  CHECK(finder_words(search, 1e-3, search.of, true).find("Stopped before any method was tried") != std::string::npos);
}

TEST_CASE("its chart has a line for each method, and leaves out what cannot be told or diverged") {
  AccuracyStudy study = study_of(test::cloth(8, 8, "verlet"));
  study.points = {point("verlet", 1e-3, 0.1), point("verlet", 1e-4, 0.2), point("verlet", 1e-9, 0.4, false),
                  point("rk4", std::numeric_limits<double>::infinity(), 0.3)};
  study.present = point("verlet", 5e-4, 0.15);
  const Chart chart = accuracy_chart(Tokens{}, study);
  REQUIRE(chart.series.size() == 2);
  CHECK(chart.series[0].name == "Verlet");
  CHECK(chart.series[0].y == std::vector<double>{1e-3, 1e-4});
  CHECK(chart.series[1].x == std::vector<double>{0.15});
  CHECK_FALSE(chart.series[1].line);
}

TEST_CASE("the stability chart rises above 1 where the method breaks") {
  Preset preset = test::cloth(8, 8, "verlet");
  preset.k_d = 0;
  StabilityLimits limits;
  limits.of = preset;
  limits.fastest = any_configuration(preset);
  limits.damped = growth_curve(scheme("verlet"), 3, 0);
  const Chart chart = stability_chart(Tokens{}, limits);
  const ChartSeries& curve = chart.series.front();
  const auto above = std::find_if(curve.y.begin(), curve.y.end(), [](double radius) { return radius > 1 + 1e-6; });
  REQUIRE(above != curve.y.end());
  CHECK(curve.x[std::size_t(above - curve.y.begin())] == doctest::Approx(2).epsilon(0.02));
  for (const double most : {3.0, 30.0, 300.0}) {  // however far beyond it the cloth is
    const GrowthCurve steep = growth_curve(scheme("verlet"), most, 0);
    CHECK(steep.radius.back() == doctest::Approx(1.25).epsilon(1e-3));
    CHECK(steep.h.back() == doctest::Approx(2.0125).epsilon(1e-3));
  }
  const auto mark = std::find_if(chart.series.begin(), chart.series.end(),
                                 [](const ChartSeries& series) { return series.name == "worst case"; });
  REQUIRE(mark != chart.series.end());
  CHECK(mark->x.front() == doctest::Approx(2 * preset.dt / stable_dt(preset, "verlet")).epsilon(1e-3));
}

}  // namespace tyglab::accuracy_card_test
