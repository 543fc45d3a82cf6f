// The rest curvature of B (core/forces/curl.cpp): the circle to which a strip curls, the energy, its bounds, and what
// every method and engine makes of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/plain/plain_cloth.h"
#include "core/forces/force.h"
#include "core/integrators/scheme.h"
#include "core/simulation.h"
#include "core/theory/advice.h"
#include "core/theory/modes.h"
#include "tests/support/scenes.h"

namespace tyglab::curl_test {

/// A strip of 1 m without weight, clamped by two rows (or columns, for the weft), which lies flat.
Preset strip(int edges, int across, bool weft, double kappa) {
  Preset p = test::quiet_cloth(weft ? across : edges + 1, weft ? edges + 1 : across, "verlet");
  p.L = 1.0 / edges, p.m = 0.01 / edges, p.k_s = 1e4, p.B = 0.02, p.tilt_deg = 0;
  p.k_d = 0.05 * std::sqrt(edges / 32.0);  // its slowest motion is damped critically
  (weft ? p.kappa_weft : p.kappa_warp) = kappa;
  p.dt = stable_dt(p, "verlet");
  p.pins.mode = Pins::Mode::list;
  for (int n = 0; n < across; ++n)
    for (const int clamped : {0, 1}) p.pins.list.push_back(weft ? Pins::Site{n, clamped} : Pins::Site{clamped, n});
  return p;
}

struct Curled {
  double turn;   ///< at each particle, rad; to the front above 0
  double apart;  ///< of the last particle from where the arc of curvature κ₀ has it, m
};
Curled curled(const Preset& p, bool weft, double kappa) {
  Simulation simulation(p);
  simulation.advance(int(std::lround(20 / p.dt)));
  const int last = (weft ? p.columns : p.rows) - 1, middle = (weft ? p.rows : p.columns) / 2;
  const auto at = [&](int n) { return weft ? simulation.position(middle, n) : simulation.position(n, middle); };
  const glm::dvec3 along = glm::normalize(at(1) - at(0)), front{0, 1, 0};
  const glm::dvec3 before = at(last / 2) - at(last / 2 - 1), after = at(last / 2 + 1) - at(last / 2);
  const auto angle = [&](glm::dvec3 d) { return std::atan2(glm::dot(d, front), glm::dot(d, along)); };
  double turn = angle(after) - angle(before);
  turn -= 2 * std::numbers::pi * std::round(turn / (2 * std::numbers::pi));
  // The arc begins in the middle of the clamped edge.
  const double s = (last - 0.5) * p.L, R = 1 / kappa;
  const glm::dvec3 end = at(0) + along * (p.L / 2 + R * std::sin(s / R)) + front * (R * (1 - std::cos(s / R)));
  return {turn, glm::distance(at(last), end)};
}

TEST_CASE("a clamped strip curls to a circle of radius 1/κ₀, to the front or to the back, along rows and columns") {
  for (const bool weft : {false, true})
    for (const int across : {2, 3}) {
      const double kappa = across == 2 ? 4 : -2;
      CAPTURE(weft);
      CAPTURE(across);
      CAPTURE(kappa);
      const Preset p = strip(12, across, weft, kappa);
      // Its threads are a little longer than at rest, by about Bκ₀²/k_s.
      CHECK(curled(p, weft, kappa).turn == doctest::Approx(std::atan(kappa * p.L)).epsilon(1e-4));
    }
}

TEST_CASE("the circle is reached with order 2 in the spacing") {
  std::vector<double> apart;
  for (const int edges : {8, 16, 32}) apart.push_back(curled(strip(edges, 3, false, 4), false, 4).apart);
  CAPTURE(apart[0]);
  CAPTURE(apart[1]);
  CAPTURE(apart[2]);
  CHECK(apart[2] < 7e-3);
  CHECK(std::log2(apart[1] / apart[2]) == doctest::Approx(2).epsilon(0.05));
}

TEST_CASE("on a cylinder the energy of B and its rest curvature is ½B(κ - κ₀)² per area") {
  Preset p = test::quiet_cloth(30, 24);
  p.B = 1e-4, p.kappa_warp = 3;
  const Tears whole(lattice_of(p));
  for (const double kappa : {-2.0, 1.0, 3.0, 5.0}) {
    CAPTURE(kappa);
    const auto x_of = [&](int i, int j) {
      return glm::dvec3(j * p.L, -std::sin(kappa * i * p.L) / kappa, (1 - std::cos(kappa * i * p.L)) / kappa);
    };
    double energy = 0;
    for (const Force* force : {&force::rigidity, &force::curl})
      for (const Stencil& stencil : force->stencils(p))
        for_each_action(p, whole, *force, stencil, x_of, x_of,
                        [&](const Points&, const ForceAction& action) { energy += action.energy; });
    const double area = (p.rows - 2) * p.columns * p.L * p.L;  // of the sites, which are those of B
    CHECK(std::abs(energy / area - p.B / 2 * std::pow(kappa - p.kappa_warp, 2)) < 1e-2 * p.B / 2 * 9);
  }
}

/// Free, taut and moving, so that no spring is slack.
Preset taut(const std::string& method) {
  Preset p = test::quiet_cloth(9, 8, method);
  p.k_s = 30, p.B = 2e-3, p.twist = 0.5, p.kappa_warp = 9, p.kappa_weft = -6, p.initial_stretch = 1.1;
  p.pins.mode = Pins::Mode::boundary, p.iterations = 100, p.tolerance = 1e-11;
  return p;
}

State after(Preset p, double dt, double t) {
  p.dt = dt;
  Simulation simulation(p);
  State start = simulation.read();
  for (std::size_t n = 0; n < start.x.x.size(); ++n)
    if (pinned_particles(p)[n] == 0) start.v.z[n] = 0.4 * std::sin(0.9 * double(n));
  test::load(simulation, start);
  simulation.advance(int(std::lround(t / dt)));
  CHECK(simulation.engine().solves().unconverged == 0);
  return simulation.read();
}

double apart(const State& a, const State& b) {
  double most = 0;
  for (std::size_t n = 0; n < a.x.x.size(); ++n)
    most = std::max(most, glm::distance(test::position(a, n), test::position(b, n)));
  return most;
}

TEST_CASE("every method keeps its order with a rest curvature") {
  const double t = 8e-3;
  const State exact = after(taut("rk4"), 1e-5, t);
  for (const Scheme& method : schemes()) {
    if (chooses_steps(method) || counts_passes(method) || projects(method)) continue;
    CAPTURE(method.name);
    const Preset p = taut(std::string(method.name));
    const double dt = method.order_undamped == 4 ? 4e-4 : 1e-4;
    const double coarse = apart(after(p, dt, t), exact), fine = apart(after(p, dt / 2, t), exact);
    CAPTURE(coarse);
    CAPTURE(fine);
    CHECK(std::log2(coarse / fine) > method.order_undamped - 0.15);
  }
}

TEST_CASE("methods that take passes come to implicit Euler's step; xpbd's error falls with dt") {
  const State exact = after(taut("implicit_euler"), 1e-3, 8e-3);
  for (const std::string method : {"vbd", "projective_dynamics"}) {
    CAPTURE(method);
    Preset p = taut(method);
    p.iterations = 1000;
    CHECK(apart(after(p, 1e-3, 8e-3), exact) < 1e-8);
  }
  const State motion = after(taut("rk4"), 1e-5, 8e-3);
  Preset p = taut("xpbd");
  p.iterations = 400;
  const double coarse = apart(after(p, 2e-4, 8e-3), motion), fine = apart(after(p, 1e-4, 8e-3), motion);
  CHECK(std::log2(coarse / fine) > 0.85);
}

TEST_CASE("a motion without damping keeps the energy that has that of the rest curvature in it") {
  for (const std::string method : {"verlet", "rk4", "implicit_midpoint"}) {
    CAPTURE(method);
    Preset p = taut(method);
    p.dt = 5e-5;
    Simulation simulation(p);
    const auto energy = [&] { return simulation.energy().energy; };
    const double begun = energy().kinetic + energy().elastic(), curl = energy().of[force::curl];
    double most = 0, moved = 0;
    for (int n = 0; n < 200; ++n) {
      simulation.advance(10);
      most = std::max(most, std::abs(energy().kinetic + energy().elastic() - begun));
      moved = std::max(moved, std::abs(energy().of[force::curl] - curl));
    }
    CHECK(moved > 1e-5);
    CHECK(most < 1e-3 * moved);
  }
}

/// The largest eigenvalue, in size, of the Hessian of F_curl where the particles are, by power iteration.
double largest(const Preset& p, const Tears& tears, const plain::Vector& x, test::Random& random) {
  Preset alone = p;
  alone.k_s = alone.k_b = alone.k_d = alone.g = 0;
  const auto pulls = [&](const plain::Vector& at) {
    plain::Vector F(at.size(), glm::dvec3(0));
    const int columns = p.columns;
    const auto x_of = [&](int i, int j) { return at[std::size_t(i * columns + j)]; };
    for (const Stencil& stencil : force::curl.stencils(alone))
      for (int i = 0; i < p.rows; ++i)
        for (int j = 0; j < columns; ++j) {
          if (!stencil.acts(tears, i, j)) continue;
          ForceAction action;
          force::curl.act(alone, stencil, points_of(stencil, i, j, x_of, x_of), action);
          for (std::size_t n = 0; n < std::size_t(stencil.points); ++n)
            F[std::size_t((i + stencil.at[n].di) * columns + j + stencil.at[n].dj)] += action.F[n];
        }
    return F;
  };
  plain::Vector u(x.size());
  for (glm::dvec3& one : u) one = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  double value = 0;
  for (int round = 0; round < 60; ++round) {
    double norm = 0;
    for (const glm::dvec3& one : u) norm += glm::dot(one, one);
    plain::Vector before = x, behind = x;
    const double h = 1e-3 * p.L / std::sqrt(norm);
    for (std::size_t n = 0; n < x.size(); ++n) before[n] += h * u[n], behind[n] -= h * u[n];
    const plain::Vector a = pulls(before), b = pulls(behind);
    double after = 0;
    for (std::size_t n = 0; n < x.size(); ++n) {
      u[n] = (b[n] - a[n]) / (2 * h);
      after += glm::dot(u[n], u[n]);
    }
    value = std::sqrt(after / norm);
    if (after == 0) break;
  }
  return value;
}

TEST_CASE("no shape whose threads are at most twice as long stiffens F_curl beyond its bound") {
  test::Random random(5);
  double nearest = 0;
  for (int trial = 0; trial < 30; ++trial) {
    Preset p = test::quiet_cloth(trial % 3 == 0 ? 3 + trial / 3 : 9, trial % 3 == 1 ? 2 : 8);
    p.B = 1e-3;
    if (trial % 4 != 1) p.kappa_warp = random.uniform(-20, 20);
    if (trial % 4 != 2) p.kappa_weft = random.uniform(-20, 20);
    Tears tears(lattice_of(p));
    for (int n = 0; trial % 5 == 4 && n < 12; ++n)
      if (const int d = random.below(2), i = random.below(p.rows), j = random.below(p.columns);
          lattice_of(p).has_spring(d, i, j))
        tears.tear(d, i, j);
    // Stretched twofold in some shapes, crumpled in others.
    plain::Vector x;
    const double stretch = trial % 2 == 0 ? 2 : 0.9, shake = trial % 2 == 0 ? 0 : 0.35;
    for (int i = 0; i < p.rows; ++i)
      for (int j = 0; j < p.columns; ++j)
        x.push_back(p.L * (stretch * glm::dvec3(j, -i, 0) +
                           shake * glm::dvec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1))));
    const double bound = force::curl.largest_eigenvalue(p), found = largest(p, tears, x, random);
    CHECK(found <= bound);
    nearest = std::max(nearest, found / bound);
  }
  MESSAGE("the largest found is ", nearest, " of the bound");
  CHECK(nearest > 0.3);
}

TEST_CASE("a rest curvature shortens the stable dt, never lengthens it, and off it changes nothing") {
  Preset p = test::quiet_cloth(9, 8);
  p.B = 1e-4;
  const Preset off = p;
  const double dt = stable_dt(p, "verlet");
  for (const double kappa : {1.0, -30.0}) {
    p.kappa_weft = kappa;
    CHECK(stable_dt(p, "verlet") < dt);
  }
  p.kappa_weft = 0;
  p.B = 0, p.kappa_warp = 5;  // of no rigidity
  CHECK_FALSE(force::curl.on(p));
  p = off, p.kappa_warp = 0;
  CHECK_FALSE(force::curl.on(p));
}

TEST_CASE("OpenCL devices refuse a rest curvature with every method, and say so") {
  for (const std::string method : {"verlet", "implicit_euler"}) {
    const Preset p = taut(method);
    REQUIRE(missing_on_opencl(p) == &force::curl);
    CHECK(words_of_missing(*missing_on_opencl(p), method) == "F_curl");
  }
  CHECK(words_of_missing(force::air, "vbd") == "F_air with vbd");
}

TEST_CASE("a finer cloth keeps the rest curvatures") {
  const Preset coarse = taut("verlet"), fine = with_resolution(coarse, 2);
  CHECK(fine.kappa_warp == coarse.kappa_warp);
  CHECK(fine.kappa_weft == coarse.kappa_weft);
}

}  // namespace tyglab::curl_test
