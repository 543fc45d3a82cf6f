// rkc2: second order with every number of stages, and an error that falls with the tolerance to the power of 2/3.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "core/integrators/scheme.h"
#include "tests/support/scenes.h"

namespace tyglab::rkc2_order_test {

/// Distance of a damped weight's y from the closed form, ζ < 1 or > 1.
double distance_from_exact(Simulation& simulation) {
  const Preset& p = simulation.preset();
  const double t = simulation.time(), y_eq = p.x_0.y - p.m * p.g / p.k, decay = p.k_d / (2 * p.m);
  const double square = p.k / p.m - decay * decay, w = std::sqrt(std::abs(square));
  const double A = p.offset + p.m * p.g / p.k, B = (p.v_0.y + decay * A) / w;
  const double c = square > 0 ? std::cos(w * t) : std::cosh(w * t), s = square > 0 ? std::sin(w * t) : std::sinh(w * t);
  return std::abs(simulation.read().x.y[0] - y_eq - std::exp(-decay * t) * (A * c + B * s));
}

/// The weight at rest but for a slow motion, with k_d = `damping` times what makes ζ = 1.
Preset weight(double damping) {
  Preset preset = test::one_weight("rkc2");
  preset.k_d = damping * 2 * std::sqrt(preset.k * preset.m);
  preset.v_0 = {0, 0.4, 0};
  return preset;
}

TEST_CASE("steps of dt make it a method of second order, with damping and without") {
  for (const double damping : {0.0, 0.3, 3.0}) {
    CAPTURE(damping);
    const auto error = [&](int steps) {
      Preset preset = weight(damping);
      preset.tolerance = 1, preset.dt = 0.23 / steps;
      Simulation simulation(preset);
      simulation.advance(steps);
      CHECK(simulation.engine().inner_steps().accepted == steps);
      return distance_from_exact(simulation);
    };
    const double order = std::log2(error(400) / error(800));
    CHECK(order > 1.9);
    CHECK(order < 2.1);
  }
}

TEST_CASE("the error of one weight falls as the tolerance to the power of two thirds") {
  for (const double damping : {0.0, 0.3}) {
    CAPTURE(damping);
    const auto error = [&](double tolerance) {
      Preset preset = weight(damping);
      preset.tolerance = tolerance, preset.dt = 0.5;
      Simulation simulation(preset);
      double worst = 0;
      for (int n = 1; n <= 4; ++n) {
        simulation.advance(1);
        worst = std::max(worst, distance_from_exact(simulation));
      }
      return worst;
    };
    const double power = std::log10(error(1e-7) / error(1e-10)) / 3;
    CHECK(power > 0.56);
    CHECK(power < 0.76);
  }
}

TEST_CASE("a taut cloth, damped heavily, moves as rk4 moves it, and the closer the smaller the tolerance") {
  Preset preset = test::cloth(5, 6, "rk4");
  preset.initial_stretch = 1.3, preset.pins.mode = Pins::Mode::boundary;
  preset.k_b = 0, preset.k_d = 0.05, preset.W = {0.002, 0.001, 0.01};
  preset.dt = 0.01;
  Preset fine = preset;
  fine.dt /= 1000;
  Simulation wanted(fine);
  wanted.advance(5000);
  const auto error = [&](double tolerance) {
    Preset own = preset;
    own.integrator = "rkc2", own.tolerance = tolerance;
    Simulation simulation(own);
    simulation.advance(5);
    double worst = 0;
    for (std::size_t p = 0; p < wanted.read().x.x.size(); ++p)
      worst = std::max(worst, glm::length(test::position(simulation.read(), p) - test::position(wanted.read(), p)));
    return worst;
  };
  CHECK(error(1e-5) < 1e-8);  // what is stable is already as good
  CHECK(error(1e-12) < 0.1 * error(1e-9));
}

}  // namespace tyglab::rkc2_order_test
