// Methods that choose their own steps: the order of their tables, and how their error falls with the tolerance.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/integrators/scheme.h"
#include "tests/support/scenes.h"

namespace tyglab::inner_steps_order_test {

struct Method {
  const char* name;
  int order;
  int steps;    ///< in 0.23 s, enough for the order to be seen
  double most;  ///< damping to test with, as ζ
  double coarse, fine;
  double power;  ///< to which of the tolerance the error falls
  double left;   ///< at most, m, with the fine one
};
// The error per unit of time is what rkc2's control keeps, in proportion to the tolerance to the power of 2/3.
constexpr Method methods[] = {{"dopri5", 5, 80, 0.3, 1e-5, 1e-9, 1, 1e-6},
                              {"rkc2", 2, 400, 3, 1e-7, 1e-10, 2.0 / 3, 1e-5}};

/// Distance of a damped weight's y and v/ω from the closed form, ζ < 1 or > 1.
double distance_from_exact(Simulation& simulation) {
  const Preset& p = simulation.preset();
  const double t = simulation.time(), y_eq = p.x_0.y - p.m * p.g / p.k, decay = p.k_d / (2 * p.m);
  const double square = p.k / p.m - decay * decay, w = std::sqrt(std::abs(square)), turns = square > 0 ? 1 : -1;
  const double A = p.offset + p.m * p.g / p.k, B = (p.v_0.y + decay * A) / w, shrunk = std::exp(-decay * t);
  const double c = square > 0 ? std::cos(w * t) : std::cosh(w * t), s = square > 0 ? std::sin(w * t) : std::sinh(w * t);
  const double y = y_eq + shrunk * (A * c + B * s);
  const double v = shrunk * ((B * w - decay * A) * c - (turns * A * w + decay * B) * s);
  const State& state = simulation.read();
  return std::hypot(state.x.y[0] - y, (state.v.y[0] - v) / w);
}

/// A weight on its way, with k_d = `damping` times what makes ζ = 1.
Preset weight(const char* method, double damping) {
  Preset preset = test::one_weight(method);
  preset.k_d = damping * 2 * std::sqrt(preset.k * preset.m);
  preset.v_0 = {0, 0.4, 0};
  return preset;
}

TEST_CASE("steps of dt have the method's order, with damping and without") {
  for (const Method& method : methods)
    for (const double damping : {0.0, 0.3, method.most}) {
      CAPTURE(std::string(method.name));
      CAPTURE(damping);
      const auto error = [&](int steps) {
        Preset preset = weight(method.name, damping);
        preset.tolerance = 1, preset.dt = 0.23 / steps;
        Simulation simulation(preset);
        simulation.advance(steps);
        CHECK(simulation.engine().inner_steps().accepted == steps);
        return distance_from_exact(simulation);
      };
      const double order = std::log2(error(method.steps) / error(2 * method.steps));
      CHECK(order > method.order * 0.95);
      CHECK(order < method.order * 1.05);
    }
}

TEST_CASE("the error of one weight falls as a power of the tolerance") {
  for (const Method& method : methods)
    for (const double damping : {0.0, 0.3}) {
      CAPTURE(std::string(method.name));
      CAPTURE(damping);
      const auto error = [&](double tolerance) {
        Preset preset = weight(method.name, damping);
        preset.tolerance = tolerance, preset.dt = 0.5;
        Simulation simulation(preset);
        double worst = 0;
        for (int n = 1; n <= 4; ++n) {
          simulation.advance(1);
          worst = std::max(worst, distance_from_exact(simulation));
        }
        return worst;
      };
      const double coarse = error(method.coarse), fine = error(method.fine);
      const double power = std::log(coarse / fine) / std::log(method.coarse / method.fine);
      CHECK(power > method.power * 0.85);
      CHECK(power < method.power * 1.15);
      CHECK(fine < method.left);
    }
}

/// A taut cloth in the wind.
Preset taut(const char* method, double k_d) {
  Preset preset = test::cloth(5, 6, method);
  preset.initial_stretch = 1.3, preset.pins.mode = Pins::Mode::boundary;
  preset.k_b = 0, preset.k_d = k_d, preset.W = {0.002, 0.001, 0.01};
  preset.dt = 0.01;
  return preset;
}

/// Largest distance of a particle from where rk4 with a small dt takes it.
double error(Preset preset, const State& wanted, double tolerance, int steps = 10) {
  preset.tolerance = tolerance;
  Simulation simulation(preset);
  simulation.advance(steps);
  double worst = 0;
  for (std::size_t p = 0; p < wanted.x.x.size(); ++p)
    worst = std::max(worst, glm::length(test::position(simulation.read(), p) - test::position(wanted, p)));
  return worst;
}

State by_rk4(Preset preset, int steps = 10) {
  constexpr int finer = 5000;
  preset.integrator = "rk4", preset.dt /= finer;
  Simulation simulation(preset);
  simulation.advance(steps * finer);
  return simulation.read();
}

TEST_CASE("dopri5: a taut cloth errs in proportion to the tolerance") {
  for (const double k_d : {0.0, 0.002}) {
    CAPTURE(k_d);
    const Preset preset = taut("dopri5", k_d);
    const State wanted = by_rk4(preset);
    const double coarse = error(preset, wanted, 1e-6), fine = error(preset, wanted, 1e-10);
    const double power = std::log10(coarse / fine) / 4;
    CHECK(power > 0.85);
    CHECK(power < 1.15);
    CHECK(fine < 1e-8);
  }
}

TEST_CASE("rkc2: a taut cloth, damped heavily, moves as rk4 moves it, and the closer the smaller the tolerance") {
  constexpr int steps = 5;  // before all has come to rest
  const Preset preset = taut("rkc2", 0.05);
  const State wanted = by_rk4(preset, steps);
  CHECK(error(preset, wanted, 1e-5, steps) < 1e-8);  // what is stable is already as good
  CHECK(error(preset, wanted, 1e-12, steps) < 0.1 * error(preset, wanted, 1e-9, steps));
}

TEST_CASE("dopri5: springs that switch cost accuracy, but a smaller tolerance still gets closer") {
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

TEST_CASE("dopri5: free fall is exact, and takes one step a dt") {
  Preset preset = test::cloth(3, 3, "dopri5");
  preset.pins.mode = Pins::Mode::none;
  preset.k_s = preset.k_b = 0;
  preset.dt = 0.1;
  Simulation simulation(preset);
  simulation.advance(10);
  CHECK(simulation.positions().at(1, 1).y - start_state(preset).x.y[4] == doctest::Approx(-9.82 / 2).epsilon(1e-12));
  CHECK(simulation.engine().inner_steps().accepted < 16);
}

}  // namespace tyglab::inner_steps_order_test
