// Motions of cloths and chains that are known on paper: normal modes, a bouncing weight, balances of momentum.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "core/integrators/scheme.h"
#include "tests/support/scenes.h"

namespace tyglab::modes_test {

using std::numbers::pi;

/// A square lattice under tension in a frame, without gravity: no spring ever switches.
Preset taut(const std::string& integrator, double dt) {
  Preset preset = test::quiet_cloth(9, 12, integrator);
  preset.initial_stretch = 1.2;
  preset.pins.mode = Pins::Mode::boundary;
  preset.dt = dt;
  return preset;
}

/// Displaces every particle out of the plane by amplitude sin(α i) sin(β j).
State in_mode(const Preset& preset, double alpha, double beta, double amplitude) {
  State state = start_state(preset);
  for (int i = 0; i < preset.rows; ++i)
    for (int j = 0; j < preset.columns; ++j)
      state.x.z[std::size_t(i) * preset.columns + j] += amplitude * std::sin(alpha * i) * std::sin(beta * j);
  return state;
}

/// What all springs do to a mode, in units of their constant: straight ones, and diagonal ones.
double mode_sum(double alpha, double beta) {
  return 2 - std::cos(alpha) - std::cos(beta) + 2 * (1 - std::cos(alpha) * std::cos(beta));
}

struct Mode {
  int p, q;
};

TEST_CASE("a mode of the taut lattice swings at ω² = (2/m) κ [(2 − cos α − cos β) + 2 (1 − cos α cos β)]") {
  for (const auto& [p, q] : {Mode{1, 1}, {2, 3}, {4, 1}, {7, 10}}) {
    CAPTURE(p);
    CAPTURE(q);
    for (const char* name : {"rk4", "verlet", "implicit_midpoint"}) {
      CAPTURE(std::string(name));
      const std::string integrator = name;
      const Preset preset = taut(integrator, integrator == "implicit_midpoint" ? 5e-4 : 1e-4);
      const double alpha = p * pi / (preset.rows - 1), beta = q * pi / (preset.columns - 1), amplitude = 1e-8;
      // κ = tension over length, the same for both kinds of springs: k_s (s - 1)/s.
      const double kappa = preset.k_s * (1 - 1 / preset.initial_stretch);
      const double w = std::sqrt(2 / preset.m * kappa * mode_sum(alpha, beta)), h = preset.dt;
      // Each method's own frequency, known of the oscillator.
      const double per_step = integrator == "verlet"              ? 2 * std::asin(h * w / 2)
                              : integrator == "implicit_midpoint" ? 2 * std::atan(h * w / 2)
                                                                  : h * w;
      Simulation simulation(preset);
      simulation.load(in_mode(preset, alpha, beta, amplitude));
      for (int n = 0; n < 400; n += 80) {
        const State wanted = in_mode(preset, alpha, beta, amplitude * std::cos(n * per_step));
        double worst = 0;
        for (std::size_t k = 0; k < wanted.x.z.size(); ++k) {
          const PositionView view = simulation.positions();
          const glm::dvec3 at = view.at(int(k) / preset.columns, int(k) % preset.columns);
          worst = std::max(worst, std::abs(at.z - wanted.x.z[k]));
        }
        CHECK(worst < 2e-3 * amplitude);
        simulation.advance(80);
      }
    }
  }
}

TEST_CASE("damping slows a mode of the taut lattice by k_d/m of the same sum") {
  Preset preset = taut("rk4", 1e-4);
  preset.k_d = 2e-4;
  const double alpha = pi / (preset.rows - 1), beta = 2 * pi / (preset.columns - 1), amplitude = 1e-8;
  const double sum = 2 / preset.m * mode_sum(alpha, beta), kappa = preset.k_s * (1 - 1 / preset.initial_stretch);
  const double decay = preset.k_d * sum / 2, w = std::sqrt(kappa * sum - decay * decay);
  Simulation simulation(preset);
  simulation.load(in_mode(preset, alpha, beta, amplitude));
  simulation.advance(300);
  const double t = 300 * preset.dt;
  const double left = std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
  const double shape = std::sin(4 * alpha) * std::sin(3 * beta);
  CHECK(std::abs(left) > 0.05);
  CHECK(simulation.positions().at(4, 3).z == doctest::Approx(amplitude * left * shape).epsilon(1e-3));
}

/// Laguerre's polynomials L_0 … L_n at x.
std::vector<double> laguerre(int n, double x) {
  std::vector<double> L{1, 1 - x};
  for (int k = 1; k < n; ++k) L.push_back(((2 * k + 1 - x) * L[k] - k * L[k - 1]) / (k + 1));
  return L;
}

/// The roots of L_n, rising.
std::vector<double> laguerre_roots(int n) {
  std::vector<double> roots;
  const auto value = [&](double x) { return laguerre(n, x)[std::size_t(n)]; };
  for (double x = 0; x < 4 * n; x += 0.01) {
    double low = x, high = x + 0.01;
    if ((value(low) > 0) == (value(high) > 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      ((value(low) > 0) == (value(middle) > 0) ? low : high) = middle;
    }
    roots.push_back(low);
  }
  return roots;
}

TEST_CASE("a hanging chain of N beads swings at ω² = λ g/L, λ the roots of Laguerre's polynomial L_N") {
  constexpr int beads = 5;
  Preset preset = test::quiet_cloth(beads + 1, 1, "rk4");
  preset.g = 9.82, preset.L = 0.1, preset.m = 0.01, preset.k_s = 1e5;  // nearly inextensible: 5e-6 m
  preset.pins.mode = Pins::Mode::top_row;
  preset.dt = 1e-4;
  const std::vector<double> roots = laguerre_roots(beads);
  REQUIRE(roots.size() == beads);
  for (const double root : roots) {
    CAPTURE(root);
    const double w = std::sqrt(root * preset.g / preset.L), amplitude = 1e-7;
    const std::vector<double> shape = laguerre(beads, root);  // from the lowest bead up
    State state = start_state(preset);
    for (int i = 1; i <= beads; ++i) {
      const double hangs_below = preset.m * preset.g * (beads + 1 - i);
      state.x.y[i] = state.x.y[i - 1] - preset.L - hangs_below / preset.k_s;
      state.x.z[i] = amplitude * shape[std::size_t(beads - i)];
    }
    Simulation simulation(preset);
    simulation.load(state);
    const int steps = int(2.1 * 2 * pi / w / preset.dt);
    simulation.advance(steps);
    const double turned = std::cos(w * steps * preset.dt);
    for (int i = 1; i <= beads; ++i)
      CHECK(simulation.positions().at(i, 0).z / amplitude ==
            doctest::Approx(turned * shape[std::size_t(beads - i)]).epsilon(2e-3).scale(1));
  }
}

/// Length of a spring at whose end a weight bounces, dropped at rest where the spring is slack: free fall, then half a
/// swing on the taut spring, and back up.
double bounce_length(const Preset& p, double slack, double t) {
  const double fall = std::sqrt(2 * slack / p.g), v = p.g * fall, w = std::sqrt(p.k_s / p.m);
  const double taut = 2 * (pi - std::atan(v * w / p.g)) / w;
  double at = std::fmod(t, 2 * fall + taut);
  if (at > fall + taut) at = 2 * fall + taut - at;  // as it fell, backwards
  if (at <= fall) return p.L - slack + p.g * at * at / 2;
  const double since = at - fall;
  return p.L + p.g / (w * w) * (1 - std::cos(w * since)) + v / w * std::sin(w * since);
}

TEST_CASE("a weight bounces between slack and taut as its pieces say") {
  for (const char* name : {"rk4", "verlet", "velocity_verlet", "implicit_midpoint"}) {
    CAPTURE(std::string(name));
    Preset preset = test::quiet_cloth(2, 1, name);
    preset.g = 9.82, preset.L = 0.3, preset.m = 0.01, preset.k_s = 40, preset.dt = 1e-4;
    preset.pins.mode = Pins::Mode::top_row;
    const double slack = 0.1;
    State state = start_state(preset);
    state.x.y[1] = state.x.y[0] - preset.L + slack;
    Simulation simulation(preset);
    simulation.load(state);
    double worst = 0, least = preset.L, most = 0;
    for (int n = 1; n <= 10000; ++n) {
      simulation.advance(1);
      const double length = preset.x_0.y - simulation.positions().at(1, 0).y;
      least = std::min(least, length), most = std::max(most, length);
      worst = std::max(worst, std::abs(length - bounce_length(preset, slack, n * preset.dt)));
    }
    CHECK(least < preset.L - 0.99 * slack);
    CHECK(most > preset.L + 0.01);
    CHECK(worst < 2e-5);
  }
}

glm::dvec3 momentum(Simulation& simulation) {
  const State& state = simulation.read();
  glm::dvec3 sum(0);
  for (std::size_t p = 0; p < state.v.x.size(); ++p) sum += test::velocity(state, p);
  return simulation.preset().m * sum;
}

glm::dvec3 angular_momentum(Simulation& simulation) {
  const State& state = simulation.read();
  glm::dvec3 sum(0);
  for (std::size_t p = 0; p < state.v.x.size(); ++p)
    sum += glm::cross(test::position(state, p), test::velocity(state, p));
  return simulation.preset().m * sum;
}

TEST_CASE("a free cloth keeps its momentum but for gravity's, with every method") {
  for (const Scheme& scheme : schemes()) {
    CAPTURE(std::string(scheme.name));
    Preset preset = test::cloth(6, 7, std::string(scheme.name));
    preset.pins.mode = Pins::Mode::none;
    preset.dt = 1e-4;
    Simulation simulation(preset);
    test::load(simulation, test::crumpled(preset, 5, 0.3, 0.4));
    const glm::dvec3 before = momentum(simulation);
    simulation.advance(200);
    const double weight = preset.m * preset.g * simulation.lattice().size();
    const glm::dvec3 wanted = before - glm::dvec3(0, weight * 200 * preset.dt, 0);
    // Implicit methods solve to a tolerance, but whatever they leave comes in pairs too.
    CHECK(glm::length(momentum(simulation) - wanted) < 1e-12);
  }
}

TEST_CASE("without damping the forces are central: velocity Verlet keeps angular momentum") {
  Preset preset = test::cloth(6, 7, "velocity_verlet");
  preset.pins.mode = Pins::Mode::none;
  preset.k_d = preset.g = 0;
  Simulation simulation(preset);
  test::load(simulation, test::crumpled(preset, 5, 0.3, 0.4));
  const glm::dvec3 before = angular_momentum(simulation);
  simulation.advance(2000);
  CHECK(glm::length(before) > 1e-5);
  CHECK(glm::length(angular_momentum(simulation) - before) < 1e-12);
}

}  // namespace tyglab::modes_test
