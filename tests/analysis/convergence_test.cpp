// The order that a scene shows: each method's own on smooth motion, from both sides, and less where something spoils
// it.
#include "core/analysis/convergence.h"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/scenes.h"

namespace tyglab::convergence_test {

const Stop never = [] { return false; };
constexpr StudyEffort effort{.reference = 4e7, .point = 1e7};

Convergence measured(const Preset& preset, double seconds) {
  Convergence last;
  measure_convergence({preset, std::nullopt}, seconds, effort, never, [&](const Convergence& now) { last = now; });
  REQUIRE(last.done);
  return last;
}

/// Taut all the time: no spring switches.
Preset taut(const std::string& integrator, double dt) {
  Preset preset = test::cloth(5, 6, integrator);
  preset.initial_stretch = 1.3;
  preset.pins.mode = Pins::Mode::boundary;
  preset.k_b = 0, preset.k_d = 0.002;
  preset.W = {0.002, 0.001, 0.01};
  preset.dt = dt;
  return preset;
}

TEST_CASE("on smooth motion every method shows its own order") {
  struct Expected {
    const char* integrator;
    double dt;
  };
  for (const auto& [integrator, dt] : {Expected{"euler", 1e-4},
                                       {"semi_implicit_euler", 1e-4},
                                       {"velocity_verlet", 5e-4},
                                       {"rk4", 1e-3},
                                       {"implicit_midpoint", 5e-4}}) {
    CAPTURE(std::string(integrator));
    const Convergence study = measured(taut(integrator, dt), 0.04);
    REQUIRE(study.points.size() == convergence_levels);
    const auto order = measured_order(study);
    REQUIRE(order);
    CHECK(order->order > nominal_order(study.of) - 0.15);
    CHECK(order->order < nominal_order(study.of) + 0.15);
    CHECK(convergence_words(study).find("Measured order") == 0);
    CHECK(convergence_words(study).find("kinks") == std::string::npos);
  }
}

TEST_CASE("Verlet has order 2 without damping, and the differences of its runs say the same") {
  Preset preset = taut("verlet", 5e-4);
  preset.k_d = 0;
  Convergence study = measured(preset, 0.04);
  CHECK(measured_order(study)->order == doctest::Approx(2).epsilon(0.05));
  study.referenced = false;
  const auto order = measured_order(study);
  REQUIRE(order);
  CHECK(order->by_differences);
  CHECK(order->order == doctest::Approx(2).epsilon(0.05));
  CHECK(convergence_words(study).find("from differences between runs") != std::string::npos);
}

TEST_CASE("what spoils the order is said") {
  Preset contact = test::cloth(8, 8, "velocity_verlet");
  contact.pins.mode = Pins::Mode::none, contact.tilt_deg = 0, contact.v_0 = {0, -1, 0}, contact.k_d = 0;
  contact.x_0 = {0, 0.305, 0};
  Body sphere;
  sphere.c = {0, 0.1, 0}, sphere.r = 0.2;
  contact.bodies = {sphere}, contact.contact = "step";
  const Convergence study = measured(contact, 0.05);
  CHECK(measured_order(study)->order < 1.7);
  CAPTURE(convergence_words(study));
  CHECK(convergence_words(study).find("Contact with bodies") != std::string::npos);

  Preset wild = taut("verlet", 0.02);
  const std::string words = convergence_words(measured(wild, 0.08));
  CHECK(words.find("it diverges") != std::string::npos);

  Preset own_steps = taut("dopri5", 1e-3);
  CHECK(convergence_words(measured(own_steps, 0.04)).find("chooses its own steps") != std::string::npos);
}

TEST_CASE("errors that the reference cannot tell are left out and named") {
  Convergence study;
  study.of = taut("rk4", 1e-3);
  study.referenced = study.done = true, study.reference.agreement_rms_m = 1e-9;
  study.points = {{1e-3, 1.6e-4, -1, true}, {5e-4, 1e-5, -1, true}, {2.5e-4, 3e-9, -1, false}};
  CHECK(measured_order(study)->order == doctest::Approx(4));
  CHECK(measured_order(study)->finest == 5e-4);
  CHECK(convergence_words(study).find("From dt = 2.5e-4 s down the error is less than ten times") != std::string::npos);
  // One that can be told makes no slope: then the runs are compared with each other.
  study.points = {{1e-3, 1e-8, 8e-9, true}, {5e-4, 3e-9, 5e-10, false}, {2.5e-4, 2e-9, -1, false}};
  CHECK(measured_order(study)->by_differences);
  CHECK(measured_order(study)->order == doctest::Approx(4));
  study.points = {{1e-3, 3e-9, -1, false}};
  CHECK_FALSE(measured_order(study).has_value());
  CHECK(convergence_words(study).find("Use a larger dt") != std::string::npos);
}

TEST_CASE("the CSV has a row for each dt") {
  Convergence study;
  study.of = taut("verlet", 1e-3);
  study.referenced = true, study.seconds = 0.25;
  study.points = {{1e-3, std::numeric_limits<double>::infinity()}, {5e-4, 2e-5, 1e-5}};
  const std::string text = convergence_csv(study);
  CHECK(text.find("\ndt [s],error [m],difference to dt/2 [m],status\n0.001,,,diverged\n0.0005,2e-05,1e-05,ok\n") !=
        std::string::npos);
}

}  // namespace tyglab::convergence_test
