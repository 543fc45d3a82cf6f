// Divergence is a result: found in the step that causes it, with a state that can still be read.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "core/integrators/scheme.h"
#include "core/theory/advice.h"
#include "core/theory/zones.h"
#include "tests/oracle/oracle.h"
#include "tests/support/scenes.h"

namespace tyglab::divergence_test {

/// Far above every limit of stability.
Preset explosive(const std::string& integrator, Precision precision) {
  Preset preset = test::cloth(7, 6, integrator);
  preset.precision = precision;
  preset.dt = 0.02;
  preset.W = {0, 0, 0.01};
  return preset;
}

/// Longest whole stretch spring over its rest length, or infinity once anything is not finite.
double worst_stretch(const oracle::Cloth& cloth, double L) {
  double worst = 0;
  for (int i = 0; i < cloth.rows(); ++i) {
    for (int j = 0; j < cloth.columns(); ++j) {
      for (const auto [di, dj] : oracle::ring) {
        if (!cloth.whole(i, j, i + di, j + dj)) continue;
        const double rest = L * std::hypot(di, dj);
        const double stretch = glm::length(cloth.at(i + di, j + dj).x - cloth.at(i, j).x) / rest;
        worst = std::isfinite(stretch) ? std::max(worst, stretch) : INFINITY;
      }
    }
  }
  return worst;
}

void check_report(const Divergence& divergence, const Simulation& simulation) {
  CHECK(divergence.step == simulation.steps() + 1);
  CHECK(divergence.t == doctest::Approx(double(divergence.step) * simulation.preset().dt));
  CHECK(simulation.lattice().contains(divergence.i, divergence.j));
  CHECK_FALSE(divergence.quantity.empty());
  CHECK_FALSE(divergence.cause.empty());
  CHECK_FALSE(divergence.advice.empty());
}

TEST_CASE("divergence is found in the very step that makes a spring 1000 times too long") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    CAPTURE(std::string(integrator));
    const Preset preset = explosive(integrator, Precision::double_);
    Simulation simulation(preset);
    const AdvanceResult advance = simulation.advance(5000);
    REQUIRE(advance.diverged);
    REQUIRE(simulation.divergence().has_value());
    CHECK(advance.steps == simulation.steps());
    check_report(*simulation.divergence(), simulation);
    CHECK(simulation.divergence()->quantity == "spring length");
    CHECK(simulation.divergence()->value > 1000 * preset.L);
    // The state is the one before that step, every number of it.
    CHECK(test::all_finite(simulation.read()));
    CHECK(test::all_finite(simulation.read_raw()));
    oracle::Cloth cloth(preset);
    cloth.advance(int(simulation.steps()));
    CHECK(worst_stretch(cloth, preset.L) <= 1000);
    cloth.step();
    CHECK(worst_stretch(cloth, preset.L) > 1000);
  }
}

TEST_CASE("found in float as well, and by single steps at the same step") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    CAPTURE(std::string(integrator));
    const Preset preset = explosive(integrator, Precision::float_);
    Simulation whole(preset), single(preset);
    CHECK(whole.advance(5000).diverged);
    int calls = 0;
    while (!single.divergence() && calls < 5000) {
      single.advance(1);
      ++calls;
    }
    REQUIRE(whole.divergence().has_value());
    REQUIRE(single.divergence().has_value());
    CHECK(whole.divergence()->step == single.divergence()->step);
    CHECK(whole.divergence()->quantity == single.divergence()->quantity);
    CHECK(whole.divergence()->i == single.divergence()->i);
    CHECK(whole.divergence()->j == single.divergence()->j);
    CHECK(test::identical(whole.read(), single.read()));
    CHECK(test::all_finite(whole.read()));
    check_report(*whole.divergence(), whole);
  }
}

TEST_CASE("numbers that overflow in one step leave no NaN behind") {
  for (const char* integrator : {"verlet", "euler", "improved_euler", "dopri5"}) {
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      CAPTURE(std::string(integrator));
      Preset preset = test::cloth(5, 5, integrator);
      preset.precision = precision;
      preset.k_s = preset.k_b = 1e9;
      preset.k_d = 1e6;
      preset.m = 1e-9;
      preset.dt = 1;
      preset.L = 10;
      preset.initial_stretch = 10;
      preset.v_0 = {1e3, -1e3, 1e3};
      preset.W = {1e3, 1e3, 1e3};
      Simulation simulation(preset);
      CHECK(test::all_finite(simulation.read()));
      simulation.advance(50);
      REQUIRE(simulation.divergence().has_value());
      CHECK(test::all_finite(simulation.read()));
      check_report(*simulation.divergence(), simulation);
      const ParticleReadout readout = simulation.particle(2, 2);
      CHECK(std::isfinite(glm::length(readout.x)));
    }
  }
}

TEST_CASE("particles without a whole spring still diverge when they are no longer finite") {
  // Cut to pieces, a particle has no spring to be too long; damping with huge k_d/m on the remaining pair overflows.
  Preset preset = test::quiet_cloth(2, 1, "euler");
  preset.precision = Precision::float_;
  preset.k_s = 0;
  preset.k_d = 1e6;
  preset.m = 1e-9;
  preset.dt = 1;
  Simulation simulation(preset);
  State state = start_state(preset);
  state.v.x[0] = 1;
  test::load(simulation, state);
  simulation.advance(10);
  REQUIRE(simulation.divergence().has_value());
  CHECK(test::all_finite(simulation.read()));
}

/// Stretched far enough that the first step tears every spring, and far above what dt allows.
Preset torn_at_once(const std::string& integrator, Precision precision) {
  Preset preset = test::cloth(32, 32, integrator);
  preset.precision = precision;
  preset.F_max = 0.1, preset.k_s = 1e6, preset.initial_stretch = 1.5, preset.dt = 1e-3;
  preset.tilt_deg = 0, preset.pins.mode = Pins::Mode::none;
  return preset;
}

TEST_CASE("an explosion that leaves no spring whole is a divergence too, with pins, without, and for any threads" *
          doctest::test_suite("slow")) {
  for (const char* integrator : {"verlet", "semi_implicit_euler", "velocity_verlet", "euler", "rk4"})
    for (const Precision precision : {Precision::float_, Precision::double_})
      for (const Pins::Mode pins : {Pins::Mode::none, Pins::Mode::top_corners}) {
        CAPTURE(std::string(integrator));
        CAPTURE(int(precision));
        Preset preset = torn_at_once(integrator, precision);
        preset.pins.mode = pins;
        Simulation simulation(preset), single(preset), threads(preset, 3);
        CHECK(simulation.advance(200).diverged);
        REQUIRE(simulation.divergence().has_value());
        const Divergence& d = *simulation.divergence();
        check_report(d, simulation);
        CHECK(d.step <= 2);
        // Springs round a pin do not tear, so one of them may be too long.
        if (pins == Pins::Mode::none || d.quantity != "spring length") {
          CHECK(d.quantity == "velocity");
          CHECK(d.value > 1e4);
          CHECK(d.cause.find("times the energy the scene can supply") != std::string::npos);
        }
        CHECK(d.advice.find("dt = ") != std::string::npos);
        CHECK(test::all_finite(simulation.read()));
        for (int n = 0; n < 200; ++n) single.advance(1);
        threads.advance(200);
        for (const Simulation* other : {&single, &threads}) {
          REQUIRE(other->divergence().has_value());
          CHECK(other->divergence()->step == d.step);
          CHECK(other->divergence()->where() == d.where());
          CHECK(other->divergence()->value == d.value);
        }
      }
}

TEST_CASE("damping that tears every spring within one step is found, and blamed") {
  Preset preset = test::cloth(19, 13, "dopri5");
  preset.k_d = 2.6e5, preset.g = 100, preset.F_max = 9e7, preset.L = 3.2e-3, preset.initial_stretch = 8;
  preset.pins.mode = Pins::Mode::none, preset.precision = Precision::float_;
  Simulation simulation(preset);
  simulation.advance(50);
  REQUIRE(simulation.divergence().has_value());
  check_report(*simulation.divergence(), simulation);
  CHECK(simulation.divergence()->advice.find("smaller k_d") != std::string::npos);
  CHECK(test::all_finite(simulation.read()));
}

TEST_CASE("a diverged run stands still until it is restarted") {
  const Preset preset = explosive("euler", Precision::double_);
  Simulation simulation(preset);
  simulation.advance(5000);
  REQUIRE(simulation.divergence().has_value());
  const auto steps = simulation.steps();
  const State before = simulation.read();
  CHECK(simulation.advance(10).steps == 0);
  CHECK(simulation.steps() == steps);
  CHECK(test::identical(simulation.read(), before));
  simulation.apply(edit::Restart{});
  CHECK_FALSE(simulation.divergence().has_value());
  CHECK(simulation.steps() == 0);
  CHECK(simulation.time() == 0);
  simulation.advance(1);
  CHECK(simulation.steps() == 1);
}

TEST_CASE("one weight diverges at 1000 times the larger of L and the offset") {
  for (const double offset : {0.1, 1e-6}) {
    CAPTURE(offset);
    Preset preset = test::one_weight("euler");
    preset.g = 0;
    preset.offset = offset;
    preset.dt = 0.05;
    Simulation simulation(preset);
    simulation.advance(100000);
    REQUIRE(simulation.divergence().has_value());
    const double limit = 1000 * std::max(preset.L, offset);
    CHECK(std::abs(simulation.read().x.y[0] - preset.x_0.y) <= limit);
    CHECK(simulation.divergence()->quantity == "distance from x_0");
    CHECK(simulation.divergence()->step == simulation.steps() + 1);
    oracle::Weight weight(preset);
    for (int n = 0; n < simulation.steps(); ++n) weight.step();
    CHECK(std::abs(weight.y - preset.x_0.y) <= limit * (1 + 1e-9));
    weight.step();
    CHECK(std::abs(weight.y - preset.x_0.y) > limit);
    CHECK(simulation.divergence()->value == doctest::Approx(std::abs(weight.y - preset.x_0.y)).epsilon(1e-6));
  }
}

TEST_CASE("what is bounded is not diverged: 10 s of free fall, and a torn spring of any length") {
  Preset preset = test::quiet_cloth(3, 1, "verlet");
  preset.g = 100;
  preset.L = 1e-4;
  preset.dt = 1e-2;
  preset.k_s = 0.1;  // stable: dt² k_s/m is far below 1
  Simulation simulation(preset);
  simulation.advance(1000);
  CHECK_FALSE(simulation.divergence().has_value());
  // The cut part falls 5 km from the pinned one; no whole spring joins them.
  preset.pins.mode = Pins::Mode::top_row;
  preset.k_s = 0;
  Simulation cut(preset);
  cut.apply(edit::Cut{{{1, 0}}});
  cut.advance(1000);
  CHECK_FALSE(cut.divergence().has_value());
}

TEST_CASE("where weight and wind are more than the springs can hold, the method is not blamed") {
  const auto falls = [](const char* integrator, double dt) {
    Preset p;
    p.rows = p.columns = 4, p.pins.mode = Pins::Mode::top_row;
    p.k_s = p.k_b = p.k_d = 0, p.L = 0.01;
    p.integrator = integrator, p.dt = dt;
    return p;
  };
  for (const Preset& preset : {falls("verlet", 1e-3), falls("verlet", 1e-2), falls("implicit_euler", 1e-2)}) {
    CAPTURE(preset.integrator);
    Simulation simulation(preset);
    REQUIRE(simulation.advance(4000).diverged);
    const Divergence& d = *simulation.divergence();
    CHECK(d.t == doctest::Approx(std::sqrt(2 * 1000 * preset.L / preset.g)).epsilon(0.02));  // ½ g t² = 1000 L
    CHECK(d.cause.find("is unstable") == std::string::npos);
    CHECK(d.cause.find("too weak for weight; ") != std::string::npos);
    CHECK(d.advice.find("larger k_s") != std::string::npos);
    CHECK_FALSE(suggested_fix(preset).has_value());
  }
  CHECK_FALSE(springs_too_weak(explosive("verlet", Precision::double_)));
  CHECK_FALSE(springs_too_weak(Preset{}));
}

TEST_CASE("the method is called unstable only where it is in every shape of the cloth") {
  Preset p = test::cloth(8, 8, "verlet");
  const auto blames = [&](double dt, Zone zone, const char* words) {
    p.dt = dt;
    CAPTURE(dt);
    CAPTURE(method_to_blame(p));
    CHECK(zone_of(p) == zone);
    CHECK(method_to_blame(p).find(words) != std::string::npos);
    CHECK((method_to_blame(p).find("is unstable here") != std::string::npos) == (zone == Zone::unstable));
  };
  const double any = stable_dt(p, p.integrator), every = every_shape_limit(p);
  REQUIRE(every > 1.1 * any);
  blames(0.9 * any, Zone::stable, "linear theory finds Verlet stable");
  blames((any + every) / 2, Zone::depends, "above the worst-case limit");
  blames(1.1 * every, Zone::unstable, "Verlet is unstable here");
  p.integrator = "implicit_euler";
  blames(0.1, Zone::stable, "solves that do not converge");
}

TEST_CASE("the suggested fix makes the change that the advice names first, and works") {
  for (const char* integrator : {"verlet", "euler", "improved_euler"}) {
    CAPTURE(std::string(integrator));
    const Preset preset = explosive(integrator, Precision::double_);
    const auto cured = suggested_fix(preset);
    REQUIRE(cured.has_value());
    CHECK(cured->integrator == "verlet");
    CHECK(cured->dt < preset.dt);
    char dt[32];
    std::snprintf(dt, sizeof dt, "dt = %.2g s", cured->dt);
    CHECK(advice(preset).find(dt) != std::string::npos);
    Simulation simulation(*cured);
    CHECK_FALSE(simulation.advance(2000).diverged);
  }
  Preset calm;
  calm.dt = 1e-6;
  CHECK_FALSE(suggested_fix(calm).has_value());
}

TEST_CASE("no advice names a dt that is not allowed, or a method that is stable at no larger dt") {
  const auto stiff = [](const char* integrator, double k_s, double dt) {
    Preset p = test::cloth(4, 4, integrator);
    p.k_s = k_s, p.k_b = 0, p.k_d = 0, p.dt = dt;
    return p;
  };
  for (const std::string_view integrator : integrator_names()) {
    CAPTURE(std::string(integrator));
    Preset hopeless = stiff(integrator.data(), 1e9, 1e-3);
    hopeless.m = 1e-6;  // Verlet needs 1.6e-8 s
    const std::string none = advice(hopeless);
    CAPTURE(none);
    for (const char* below : {"e-8 s", "e-9 s", "e-10 s", "e-11 s"}) CHECK(none.find(below) == std::string::npos);
    CHECK(none.find("Verlet") == std::string::npos);
    CHECK_FALSE(suggested_fix(hopeless).has_value());
  }
  for (const char* integrator : {"velocity_verlet", "semi_implicit_euler", "rk4"}) {
    CAPTURE(std::string(integrator));
    const Preset preset = stiff(integrator, 1e4, 1e-2);
    CHECK(advice(preset).find("verlet and") == std::string::npos);
    CHECK(advice(preset).starts_with("Use dt = "));
    const auto fixed = suggested_fix(preset);
    REQUIRE(fixed.has_value());
    CHECK(fixed->integrator == integrator);
  }
  CHECK(advice(stiff("euler", 1e4, 1e-2)).starts_with("Use Verlet with dt = "));
  Preset bent = stiff("verlet", 50, 1e-3);
  bent.k_b = 1e5;
  CHECK(advice(bent).find("or a smaller k_b, and restart") != std::string::npos);
}

TEST_CASE("advice names k_s only where it is the largest constant that acts") {
  Preset p = test::cloth(8, 8);
  p.k_b = 0, p.k_d = 0, p.dt = 0.1;
  const auto named = [&](const char* key) {
    CAPTURE(advice(p));
    CHECK(advice(p).find(std::string("or a smaller ") + key + ", and restart") != std::string::npos);
    CHECK(advice_for_weak_springs(p).starts_with(std::string("Use a larger ") + key + ", or less weight"));
  };
  named("k_s");
  p.k_warp = 0.5 * p.k_s, p.k_weft = p.k_s;
  named("k_s");
  p.k_warp = 2 * p.k_s;
  named("k_warp");
  p.k_weft = 3 * p.k_s, p.k_shear = 0.1 * p.k_s;
  named("k_weft");
  p.k_s = 1e6;
  named("k_weft");
}

}  // namespace tyglab::divergence_test
