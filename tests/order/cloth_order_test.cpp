// The cloth's motion against an independent integrator (Boost.Odeint, Dormand and Prince, tight tolerances) on the
// oracle's forces: every method converges to the same motion, with its order.
#include <doctest/doctest.h>

#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "core/integrators/scheme.h"
#include "tests/oracle/oracle.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::cloth_order_test {

constexpr double end_time = 0.05;  // s

/// Taut all the time, so that no spring switches and the motion is as smooth as the methods assume.
Preset taut_cloth(const std::string& integrator, double k_d) {
  Preset preset = test::cloth(5, 6, integrator);
  preset.initial_stretch = 1.3;
  preset.pins.mode = Pins::Mode::boundary;
  preset.k_b = 0;
  preset.k_d = k_d;
  preset.W = {0.002, 0.001, 0.01};
  return preset;
}

/// Positions of all particles at end_time, by odeint.
std::vector<glm::dvec3> reference(const Preset& preset) {
  Preset plain = preset;
  plain.integrator = "euler";  // the oracle's velocity is then v itself
  oracle::Cloth cloth(plain);
  const int count = cloth.rows() * cloth.columns();
  const auto particle = [&](int p) -> oracle::Particle& { return cloth.at(p / cloth.columns(), p % cloth.columns()); };
  using Vector = std::vector<double>;
  Vector y(std::size_t(count) * 6);
  for (int p = 0; p < count; ++p) {
    for (int c = 0; c < 3; ++c) y[6 * p + c] = particle(p).x[c], y[6 * p + 3 + c] = particle(p).v[c];
  }
  const auto derivative = [&](const Vector& from, Vector& dydt, double) {
    for (int p = 0; p < count; ++p) {
      for (int c = 0; c < 3; ++c) particle(p).x[c] = from[6 * p + c], particle(p).v[c] = from[6 * p + 3 + c];
    }
    for (int p = 0; p < count; ++p) {
      const glm::dvec3 force = cloth.forces(p / cloth.columns(), p % cloth.columns()).F();
      for (int c = 0; c < 3; ++c) {
        dydt[6 * p + c] = from[6 * p + 3 + c];
        dydt[6 * p + 3 + c] = particle(p).pinned ? 0 : force[c] / preset.m;
      }
    }
  };
  namespace odeint = boost::numeric::odeint;
  odeint::integrate_adaptive(odeint::make_controlled<odeint::runge_kutta_dopri5<Vector>>(1e-12, 1e-12), derivative, y,
                             0.0, end_time, 1e-4);
  std::vector<glm::dvec3> x;
  for (int p = 0; p < count; ++p) x.emplace_back(y[6 * p], y[6 * p + 1], y[6 * p + 2]);
  return x;
}

double error(Preset preset, int steps, const std::vector<glm::dvec3>& exact) {
  preset.dt = end_time / steps;
  Simulation simulation(preset);
  simulation.advance(steps);
  double squares = 0;
  for (std::size_t p = 0; p < exact.size(); ++p) {
    const double d = glm::length(test::position(simulation.read(), p) - exact[p]);
    squares += d * d;
  }
  return std::sqrt(squares / double(exact.size()));
}

TEST_CASE("on a taut cloth each method converges to odeint's motion with its order" * doctest::test_suite("slow")) {
  for (const Scheme& scheme : schemes())
    for (const double k_d : {0.0, 0.002}) {
      if (chooses_steps(scheme)) continue;        // inner_steps_order_test.cpp
      if (test::sanitized && k_d == 0) continue;  // nothing that damping leaves out
      CAPTURE(std::string(scheme.name));
      CAPTURE(k_d);
      const Preset preset = taut_cloth(std::string(scheme.name), k_d);
      const int order = k_d > 0 ? scheme.order_damped : scheme.order_undamped;
      const auto exact = reference(preset);
      const int steps = order == 4 ? 100 : 2000;
      const double coarse = error(preset, steps, exact), fine = error(preset, 2 * steps, exact);
      const double measured = std::log2(coarse / fine);
      CHECK(measured > order - 0.1);
      CHECK(measured < order + 0.1);
      CHECK(fine < (order == 1 ? 2e-4 : 1e-7));
      CHECK(fine > 1e-11);
    }
}

}  // namespace tyglab::cloth_order_test
