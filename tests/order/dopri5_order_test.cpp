// dopri5: its error falls with the tolerance, in proportion and no faster; its table is of fifth order.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/integrators/scheme.h"
#include "tests/support/scenes.h"

namespace tyglab::dopri5_order_test {

/// Distance of a weight's y and v/ω from the closed form.
double distance_from_exact(Simulation& simulation) {
  const Preset& p = simulation.preset();
  const double t = simulation.time();
  const double y_eq = p.x_0.y - p.m * p.g / p.k, decay = p.k_d / (2 * p.m);
  const double w = std::sqrt(p.k / p.m - decay * decay);
  const double A = p.offset + p.m * p.g / p.k, B = (p.v_0.y + decay * A) / w;
  const double c = std::cos(w * t), s = std::sin(w * t), shrunk = std::exp(-decay * t);
  const double y = y_eq + shrunk * (A * c + B * s), v = shrunk * ((B * w - decay * A) * c - (A * w + decay * B) * s);
  const State& state = simulation.read();
  return std::hypot(state.x.y[0] - y, (state.v.y[0] - v) / w);
}

Preset weight(double k_d) {
  Preset preset = test::one_weight("dopri5");
  preset.k_d = k_d, preset.v_0 = {0, 0.4, 0};
  return preset;
}

TEST_CASE("steps of dt make it a method of fifth order, with damping and without") {
  for (const double k_d : {0.0, 0.2}) {
    CAPTURE(k_d);
    const auto error = [&](int steps) {
      Preset preset = weight(k_d);
      preset.tolerance = 1, preset.dt = 0.23 / steps;
      Simulation simulation(preset);
      simulation.advance(steps);
      CHECK(simulation.engine().inner_steps().accepted == steps);
      return distance_from_exact(simulation);
    };
    const double order = std::log2(error(80) / error(160));
    CHECK(order > 4.8);
    CHECK(order < 5.2);
  }
}

TEST_CASE("the error of one weight falls in proportion to the tolerance") {
  for (const double k_d : {0.0, 0.2}) {
    CAPTURE(k_d);
    const auto error = [&](double tolerance) {
      Preset preset = weight(k_d);
      preset.tolerance = tolerance, preset.dt = 0.5;
      Simulation simulation(preset);
      double worst = 0;
      for (int n = 1; n <= 4; ++n) {
        simulation.advance(1);
        worst = std::max(worst, distance_from_exact(simulation));
      }
      return worst;
    };
    const double coarse = error(1e-5), fine = error(1e-9);
    const double power = std::log10(coarse / fine) / 4;
    CHECK(power > 0.85);
    CHECK(power < 1.15);
    CHECK(fine < 1e-6);
  }
}

TEST_CASE("free fall is exact, and takes one step a dt") {
  Preset preset = test::cloth(3, 3, "dopri5");
  preset.pins.mode = Pins::Mode::none;
  preset.k_s = preset.k_b = 0;
  preset.dt = 0.1;
  Simulation simulation(preset);
  simulation.advance(10);
  CHECK(simulation.positions().at(1, 1).y - start_state(preset).x.y[4] == doctest::Approx(-9.82 / 2).epsilon(1e-12));
  CHECK(simulation.engine().inner_steps().accepted < 16);
}

/// Largest distance of a particle from where rk4 with a small dt takes it.
double error(Preset preset, const State& wanted, double tolerance) {
  preset.tolerance = tolerance;
  Simulation simulation(preset);
  simulation.advance(10);
  double worst = 0;
  for (std::size_t p = 0; p < wanted.x.x.size(); ++p)
    worst = std::max(worst, glm::length(test::position(simulation.read(), p) - test::position(wanted, p)));
  return worst;
}

State by_rk4(Preset preset) {
  const int steps = 5000;
  preset.integrator = "rk4", preset.dt /= steps;
  Simulation simulation(preset);
  simulation.advance(10 * steps);
  return simulation.read();
}

TEST_CASE("a taut cloth errs in proportion to the tolerance") {
  for (const double k_d : {0.0, 0.002}) {
    CAPTURE(k_d);
    Preset preset = test::cloth(5, 6, "dopri5");
    preset.initial_stretch = 1.3, preset.pins.mode = Pins::Mode::boundary;
    preset.k_b = 0, preset.k_d = k_d, preset.W = {0.002, 0.001, 0.01};
    preset.dt = 0.01;
    const State wanted = by_rk4(preset);
    const double coarse = error(preset, wanted, 1e-6), fine = error(preset, wanted, 1e-10);
    const double power = std::log10(coarse / fine) / 4;
    CHECK(power > 0.85);
    CHECK(power < 1.15);
    CHECK(fine < 1e-8);
  }
}

TEST_CASE("springs that switch cost accuracy, but a smaller tolerance still gets closer") {
  for (const double k_d : {0.0, 0.002}) {
    CAPTURE(k_d);
    Preset preset = test::cloth(6, 6, "dopri5");
    preset.k_d = k_d, preset.dt = 0.01;
    const State wanted = by_rk4(preset);
    double before = INFINITY;
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      CAPTURE(tolerance);
      const double now = error(preset, wanted, tolerance);
      CHECK(now < 0.5 * before);
      before = now;
    }
    CHECK(before < 1e-6);
  }
}

}  // namespace tyglab::dopri5_order_test
