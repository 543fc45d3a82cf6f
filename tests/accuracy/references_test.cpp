// What errors are measured with: forces written apart from the engine, two independent references, the ladder's rules.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/analysis/accuracy.h"
#include "core/analysis/engine_forces.h"
#include "core/engines/plain/plain_cloth.h"
#include "core/integrators/scheme.h"
#include "core/theory/advice.h"
#include "core/theory/modes.h"
#include "tests/oracle/oracle.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::references_test {

bool never() {
  return false;
}

AccuracyScene scene_called(const std::string& name) {
  for (AccuracyScene& scene : accuracy_scenes())
    if (scene.name == name) return scene;
  FAIL("there is no scene " << name);
  return {};
}

TEST_CASE("the heavily damped scenes have 3.5 times the critical damping in the fastest mode of any shape") {
  for (const char* name : {"damped", "stiff"}) {
    const AccuracyScene scene = scene_called(name);
    CHECK(scene.damped);
    const Mode fastest = any_configuration(scene.preset);
    CHECK(fastest.damping / (2 * fastest.omega()) == doctest::Approx(3.5).epsilon(0.02));
    // So every explicit method's dt is limited by damping, not by the oscillation.
    CHECK(stable_dt(scene.preset, "verlet") < 0.3 / fastest.omega());
  }
}

TEST_CASE("what needs no stability is tried from coarse steps on, the others from about their limits") {
  const AccuracyScene scene = scene_called("stiff");
  Reference reference = make_reference(scene, true, never);
  const AccuracyEffort effort{0.001, false, 0, 0};
  const auto coarsest = [&](const char* name) {
    return measure_integrator(scene, reference, name, Precision::double_, effort, never).front().dt;
  };
  CHECK(coarsest("implicit_euler") > 0.02);
  CHECK(coarsest("verlet") < 2.01 * stable_dt(scene.preset, "verlet"));
  CHECK(coarsest("damped_verlet") > 1.01 * stable_dt(scene.preset, "damped_verlet"));
}

/// Wind, bending, damping, pins, an odd size.
Preset everything() {
  Preset preset = test::cloth(7, 9, "euler");
  preset.W = {2e-3, 1e-3, -4e-3};
  return preset;
}

TEST_CASE("the plain forces and the engine's are the oracle's") {
  const Preset preset = everything();
  const State state = test::crumpled(preset, 3, 0.4, 0.6);
  oracle::Cloth cloth(preset);
  test::load(cloth, state);
  EngineForces<double> engine(preset);
  const std::size_t count = state.x.x.size();
  plain::Vector x(count), v(count);
  auto y = engine.start();
  auto change = y;
  for (std::size_t p = 0; p < count; ++p) {
    x[p] = test::position(state, p), v[p] = test::velocity(state, p);
    for (int c = 0; c < 3; ++c) {
      const std::size_t stride = engine.half() / preset.rows / 3;
      const std::size_t at = (p / preset.columns * 3 + c) * stride + p % preset.columns;
      y[at] = x[p][c], y[engine.half() + at] = v[p][c];
    }
  }
  const plain::Vector F = plain::forces(preset, Tears(lattice_of(preset)), x, v);
  engine.derivative(y, change);
  for (std::size_t p = 0; p < count; ++p) {
    const int i = int(p) / preset.columns, j = int(p) % preset.columns;
    CAPTURE(i);
    CAPTURE(j);
    const glm::dvec3 wanted = cloth.at(i, j).pinned ? glm::dvec3(0) : cloth.forces(i, j).F() / preset.m;
    const std::size_t stride = engine.half() / preset.rows / 3;
    for (int c = 0; c < 3; ++c) {
      if (!cloth.at(i, j).pinned) CHECK(F[p][c] / preset.m == doctest::Approx(wanted[c]).epsilon(1e-11).scale(100));
      CHECK(change[engine.half() + (std::size_t(i) * 3 + c) * stride + j] ==
            doctest::Approx(wanted[c]).epsilon(1e-11).scale(100));
    }
    CHECK(engine.position(y, int(p)) == test::position(state, p));
  }
  CHECK(engine.evaluations() == 1);
}

TEST_CASE("two independent references of a moving cloth agree") {
  for (const char* name : {"hanging", "taut_sheet"}) {
    CAPTURE(std::string(name));
    AccuracyScene scene = scene_called(name);
    scene.seconds = 0.02;
    const Track outside = odeint_track(scene, 1e-10, never), own = own_track(scene, "rk4", 1000, never);
    CHECK(rms_distance(outside, own) < 1e-8);
    CHECK(rms_distance(outside, own_track(scene, "verlet", 10, never)) > 1e-7);
  }
}

TEST_CASE("every method's row holds what it claims, and converges") {
  AccuracyScene scene = scene_called("taut_sheet");
  scene.seconds = 0.01;
  Reference reference;
  reference.track = odeint_track(scene, 1e-11, never);
  const AccuracyEffort effort{test::sanitized ? 1 : 0.2, false, 0};
  for (const std::string_view name : integrator_names()) {
    CAPTURE(std::string(name));
    const auto rows = measure_integrator(scene, reference, std::string(name), Precision::double_, effort, never);
    REQUIRE(rows.size() > 3);
    for (const AccuracyRow& row : rows)
      if (row.status == AccuracyStatus::ok) {
        CHECK(row.dt * double(row.steps) == doctest::Approx(scene.seconds));
        CHECK(row.force_evaluations >= row.steps);
        CHECK(row.seconds > 0);
      }
    CHECK(rows.back().error_rms_m < 0.2 * rows.front().error_rms_m);
  }
  for (const std::string& name : odeint_methods()) {
    CAPTURE(name);
    const auto rows = measure_odeint(scene, reference, name, Precision::double_, effort, never);
    REQUIRE(rows.size() > 3);
    CHECK(rows.back().error_rms_m < 1e-5);
  }
}

AccuracyRow row(const std::string& integrator, double seconds, double error,
                AccuracyStatus status = AccuracyStatus::ok) {
  AccuracyRow made{"taut_sheet", integrator};
  made.dt = 1e-3 / seconds;
  made.seconds = seconds, made.error_rms_m = error, made.status = status;
  return made;
}

TEST_CASE("an error under ten times the references' difference is below the floor") {
  Reference reference;
  reference.agreement_rms_m = 1e-9;
  CHECK(judged(reference, 1.1e-8) == AccuracyStatus::ok);
  CHECK(judged(reference, 0.9e-8) == AccuracyStatus::below_floor);
  CHECK(judged(reference, INFINITY) == AccuracyStatus::diverged);
}

TEST_CASE("who wins at an error: between two rows, at the largest stable dt, or nobody") {
  const std::vector<AccuracyRow> rows{row("verlet", 1, INFINITY, AccuracyStatus::diverged), row("verlet", 2, 1e-4),
                                      row("verlet", 4, 1e-6), row("odeint_runge_kutta4", 6, 1e-3),
                                      row("odeint_runge_kutta4", 12, 1e-5)};
  const auto methods = by_method(rows);
  REQUIRE(methods.size() == 2);
  CHECK(reached(methods[0], 1e-3)->seconds == 2);
  CHECK(reached(methods[0], 1e-3)->at_largest_dt);
  CHECK(reached(methods[0], 1e-5)->seconds == doctest::Approx(std::sqrt(8.0)));
  CHECK_FALSE(reached(methods[0], 1e-5)->at_largest_dt);
  CHECK_FALSE(reached(methods[1], 1e-6).has_value());
  Reference reference;
  reference.agreement_rms_m = 2e-7;
  const auto winners = accuracy_winners(rows, reference);
  REQUIRE(winners.size() == 4);  // 1e-6 cannot be told
  CHECK(winners[3].error_rms_m == doctest::Approx(1e-5));
  CHECK(winners[3].integrator == "verlet");
  CHECK(winners[3].odeint == "odeint_runge_kutta4");
  CHECK(winners[3].odeint_seconds == doctest::Approx(12));
}

TEST_CASE("a ladder ends at the floor, at the time allowed, or where rounding makes the error grow") {
  const AccuracyEffort effort{0.5, false, 0};
  CHECK(worth_going_on({}, effort));
  CHECK(worth_going_on({row("verlet", 0.1, 1e-3)}, effort));
  CHECK_FALSE(worth_going_on({row("verlet", 0.1, 1e-9, AccuracyStatus::below_floor)}, effort));
  CHECK_FALSE(worth_going_on({row("verlet", 0.3, 1e-3)}, effort));
  CHECK(worth_going_on({row("verlet", 0.3, INFINITY, AccuracyStatus::diverged)}, effort));
  CHECK_FALSE(worth_going_on(
      {row("verlet", 0.01, 1e-6), row("verlet", 0.02, 2e-6), row("verlet", 0.04, 3e-6), row("verlet", 0.08, 4e-6)},
      effort));
}

}  // namespace tyglab::references_test
