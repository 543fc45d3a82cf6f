// Gusts: a function of simulated time alone, the same wind through every step, nothing at all where they are off.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/forces/contact.h"
#include "core/lockstep.h"
#include "core/step_trace.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::gust_test {

Preset windy(const char* integrator = "verlet") {
  Preset preset = test::cloth(9, 8, integrator);
  preset.W = {0.002, 0, 0.001};
  preset.gust = 0.8, preset.gust_period = 0.3;
  preset.dt = 5e-4;
  return preset;
}

TEST_CASE("the wave stays within its strength, comes back to its mean and has no jumps") {
  double sum = 0, least = 0, most = 0, steepest = 0;
  constexpr int samples = 100000;
  for (int n = 0; n < samples; ++n) {
    const double t = 0.002 * n, wave = gust_wave(t, 2);
    sum += wave, least = std::min(least, wave), most = std::max(most, wave);
    steepest = std::max(steepest, std::abs(gust_wave(t + 1e-4, 2) - wave) / 1e-4);
  }
  CHECK(std::abs(sum / samples) < 0.01);
  CHECK(least >= -1);
  CHECK(most <= 1);
  CHECK(most - least > 1.6);
  CHECK(steepest < 5);  // 2π/T times the weighted sum of the three frequencies
}

TEST_CASE("spans end where the next begins, and cloths of unlike dt feel the same wind") {
  const Preset preset = windy();
  Preset fine = preset;
  fine.dt = preset.dt / 4;
  int steps = 0;
  while (steps * preset.dt < 1) {
    const double t = steps * preset.dt;
    const GustSpan span = gust_span(preset, t);
    CHECK(span.steps <= 10);  // 0.3 s / 64 / dt
    for (int n = 0; n < span.steps; ++n) CHECK(gust_span(preset, t + n * preset.dt).factor == span.factor);
    // In the middle of the span the wave itself, up to what it changes in half a 64th of its period.
    CHECK(std::abs(gust_span(fine, t).factor - span.factor) < 0.2);
    CHECK(std::abs(span.factor - 1 - 0.8 * gust_wave(t, 0.3)) < 0.2);
    steps += span.steps;
  }
  Preset coarse = preset;
  coarse.dt = 0.01;
  CHECK(gust_span(coarse, 0.4).steps == 1);
  CHECK(gust_span(coarse, 0.4).factor == 1 + 0.8 * gust_wave(0.405, 0.3));
}

TEST_CASE("where gusts are off, or there is no wind, not a bit changes") {
  Preset plain = windy();
  plain.gust = 0;
  Preset period = plain;
  period.gust_period = 7;
  Preset calm = windy();
  calm.W = {0, 0, 0};
  Preset calm_plain = calm;
  calm_plain.gust = 0;
  for (const auto& [a, b] : {std::pair{plain, period}, {calm, calm_plain}}) {
    Simulation first(a), second(b);
    first.advance(200), second.advance(200);
    CHECK(test::identical(first.read_raw(), second.read_raw()));
  }
}

TEST_CASE("gusts move the cloth, and however the steps are asked for it moves alike") {
  for (const char* integrator :
       {"verlet", "velocity_verlet", "rk4", "dopri5", "implicit_euler", "projective_dynamics", "vbd", "xpbd"}) {
    CAPTURE(std::string(integrator));
    Simulation whole(windy(integrator)), pieces(windy(integrator));
    Preset steady = windy(integrator);
    steady.gust = 0;
    Simulation other(steady);
    whole.advance(300), other.advance(300);
    for (int n = 0; n < 100; ++n) pieces.advance(3);
    CHECK(test::identical(whole.read_raw(), pieces.read_raw()));
    CHECK(rms_distance(whole, other) > 1e-4);
  }
}

TEST_CASE("copies in gusts stay equal to the bit, and those of another dt feel the same gusts") {
  Simulation original(windy());
  original.advance(37);
  Lockstep copies;
  copies.add(original, {});
  copies.add(original, {{&Preset::dt, 0.000125}});
  for (int n = 0; n < 10; ++n) original.advance(20), copies.follow(original.time());
  CHECK(test::identical(original.read_raw(), copies[0].simulation->read_raw()));
  CHECK(rms_distance(*copies[1].simulation, original) < 1e-4);
}

TEST_CASE("what is read in a gust is the wind that blows: the force on a particle, the step written out") {
  Simulation simulation(windy());
  simulation.advance(173);
  const glm::dvec3 now = simulation.wind();
  CHECK(glm::length(now - simulation.preset().W) > 1e-5);
  Preset steady = simulation.preset();
  steady.gust = 0, steady.W = now;
  Simulation other(steady);
  test::load(other, simulation.read());
  CHECK(glm::length(other.particle(4, 4)["F_wind"] - simulation.particle(4, 4)["F_wind"]) < 1e-12);
  const StepTrace trace = trace_step(simulation, 4, 4);
  simulation.advance(1);
  CHECK(glm::length(trace.x_after - simulation.positions().at(4, 4)) < 1e-13);
}

TEST_CASE("the ledger explains what gusts do: no energy comes from nowhere") {
  Preset preset = windy("rk4");
  Simulation gusty(preset);
  gusty.enable_ledger(true);
  preset.gust = 0;
  Simulation steady(preset);
  steady.enable_ledger(true);
  gusty.advance(1000), steady.advance(1000);
  CHECK(std::abs(gusty.ledger()->share()) < 3 * std::abs(steady.ledger()->share()) + 1e-4);
}

TEST_CASE("a snapshot brings its gust back") {
  Simulation simulation(windy());
  simulation.advance(100);
  const Snapshot then = simulation.snapshot();
  simulation.restore(then);
  simulation.advance(150);
  const State first = simulation.read_raw();
  simulation.restore(then);
  simulation.advance(150);
  CHECK(test::identical(first, simulation.read_raw()));
}

TEST_CASE("the OpenCL engine blows the same gusts") {
  if (test::skipped_without_device()) return;
  Preset preset = windy();
  Simulation cpu(preset);
  preset.engine = EngineKind::opencl;
  Simulation device(preset);
  cpu.advance(200), device.advance(200);
  CHECK(rms_distance(device, cpu) < 1e-9);
}

}  // namespace tyglab::gust_test
