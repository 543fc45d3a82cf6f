// The extreme modes of a cloth as it stands, against dense linear algebra on the oracle's forces and closed forms.
#include "core/analysis/frequency.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/analysis/boundary.h"
#include "core/theory/advice.h"
#include "core/theory/modes.h"
#include "core/theory/zones.h"
#include "tests/support/scenes.h"

namespace tyglab::frequency_test {

/// -∂F/∂x (or -∂F/∂v) over m of the free particles, by central differences of the oracle's forces.
Matrix differentiated(const Preset& preset, const State& state, bool by_velocity) {
  oracle::Cloth cloth(preset);
  test::load(cloth, state);
  std::vector<int> free;
  const auto pinned = pinned_particles(preset);
  for (std::size_t p = 0; p < pinned.size(); ++p)
    if (pinned[p] == 0) free.push_back(int(p));
  const int size = 3 * int(free.size());
  Matrix matrix{size, std::vector<double>(std::size_t(size) * size, 0)};
  const double step = 1e-7 * (by_velocity ? 1 : preset.L);
  for (int column = 0; column < size; ++column) {
    const int p = free[std::size_t(column / 3)];
    oracle::Particle& moved = cloth.at(p / preset.columns, p % preset.columns);
    double& value = (by_velocity ? moved.v : moved.x)[column % 3];
    for (const double side : {1.0, -1.0}) {
      const double before = value;
      value += side * step;
      for (int row = 0; row < size; ++row) {
        const int q = free[std::size_t(row / 3)];
        const auto F = cloth.forces(q / preset.columns, q % preset.columns).F();
        matrix.at(row, column) -= side * F[row % 3] / (2 * step * preset.m);
      }
      value = before;
    }
  }
  return matrix;
}

/// The largest eigenvalue of a symmetric matrix, by plain power iteration on it shifted to be positive.
double largest_eigenvalue(Matrix matrix) {
  double shift = 0;
  for (int i = 0; i < matrix.size; ++i) {
    double row = 0;
    for (int j = 0; j < matrix.size; ++j) row += std::abs(matrix.at(i, j));
    shift = std::max(shift, row);
  }
  std::vector<double> u(std::size_t(matrix.size));
  test::Random random(5);
  for (double& part : u) part = random.uniform(-1, 1);
  double value = 0;
  for (int n = 0; n < 6000; ++n) {
    std::vector<double> next(u.size(), 0);
    for (int i = 0; i < matrix.size; ++i) {
      next[std::size_t(i)] = shift * u[std::size_t(i)];
      for (int j = 0; j < matrix.size; ++j) next[std::size_t(i)] += matrix.at(i, j) * u[std::size_t(j)];
    }
    double norm = 0;
    for (const double part : next) norm = std::hypot(norm, part);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = next[i] / norm;
    value = norm - shift;
  }
  return value;
}

TEST_CASE("stiffness and damping of a crumpled cloth are those of its differentiated forces") {
  for (const std::uint64_t seed : {1, 2, 3}) {
    CAPTURE(seed);
    Preset preset = test::cloth(4, 5);
    preset.k_d = 0.003, preset.k_b = 40;
    const State state = test::crumpled(preset, seed);
    Simulation simulation(preset);
    test::load(simulation, state);
    const Linearisation cloth(simulation);
    const double stiffness = largest_eigenvalue(differentiated(preset, state, false));
    const double damping = largest_eigenvalue(differentiated(preset, state, true));
    CHECK(cloth.largest_stiffness(1e-9) == doctest::Approx(stiffness).epsilon(1e-4));
    CHECK(cloth.largest_damping(1e-9) == doctest::Approx(damping).epsilon(1e-4));
    CHECK(cloth.extreme(1, 0, 1e-9).stiffness == doctest::Approx(stiffness).epsilon(1e-4));
    CHECK(stiffness < any_configuration(preset).stiffness);
    CHECK(damping < any_configuration(preset).damping);
  }
}

TEST_CASE("springs that push and buckle, with much negative stiffness, do not hide the largest positive one") {
  Preset preset = test::quiet_cloth(5, 5);
  preset.k_s = 1, preset.k_b = 100;
  preset.initial_stretch = 0.2;  // all bending springs push at a fifth of their length: across them -4 k_b
  preset.pins.mode = Pins::Mode::top_row;
  Simulation simulation(preset);
  const double expected = largest_eigenvalue(differentiated(preset, start_state(preset), false));
  CHECK(expected > 0);
  CHECK(Linearisation(simulation).largest_stiffness(1e-9) == doctest::Approx(expected).epsilon(1e-4));
}

TEST_CASE("a taut sheet's fastest wave is (π, 0), in its plane: ω² = (8 k_s + 4 κ)/m, damping 12 k_d/m") {
  const Preset preset = taut_sheet(64, 50, 2e-4, "verlet");
  const Mode mode = Linearisation(Simulation(preset)).extreme(1, 0, exact_tolerance);
  const double tension_over_length = preset.k_s * (1 - 1 / preset.initial_stretch);
  const double endless = (8 * preset.k_s + 4 * tension_over_length) / preset.m;
  CHECK(mode.stiffness < endless);  // a clamped one is a little slower
  CHECK(mode.stiffness == doctest::Approx(endless).epsilon(2e-3));
  CHECK(mode.damping == doctest::Approx(12 * preset.k_d / preset.m).epsilon(2e-3));
}

TEST_CASE("transverse modes alone have their closed form: one row between two walls") {
  // With one column there are no diagonals: ω² = (κ/m) 2 (1 - cos β) across, β = nπ/(R-1), and k_s in place of κ along.
  Preset preset = taut_sheet(9, 50, 0, "verlet");
  preset.columns = 1;
  preset.pins.mode = Pins::Mode::list, preset.pins.list = {{0, 0}, {8, 0}};
  const double expected = 2 * preset.k_s / preset.m * (1 - std::cos(7 * std::numbers::pi / 8));
  CHECK(Linearisation(Simulation(preset)).largest_stiffness(1e-10) == doctest::Approx(expected).epsilon(1e-9));
}

TEST_CASE("a cloth that is slack, or pinned altogether, has no stiffness; one weight has its own") {
  Preset slack = test::quiet_cloth(6, 6);
  slack.initial_stretch = 0.99;
  CHECK(Linearisation(Simulation(slack)).largest_stiffness(1e-6) == 0);
  Preset pinned = taut_sheet(3, 50, 1e-3, "verlet");
  pinned.pins.mode = Pins::Mode::list;
  for (int p = 0; p < 9; ++p) pinned.pins.list.push_back({p / 3, p % 3});
  CHECK(fastest_mode(Linearisation(Simulation(pinned)), 1e-6).stiffness == 0);
  CHECK(std::isinf(dt_crit(scheme("verlet"), extreme_modes(Linearisation(Simulation(pinned)), 1e-6))));
  Preset weight = test::one_weight();
  weight.k_d = 0.5;
  const Mode mode = fastest_mode(Linearisation(Simulation(weight)), 1e-6);
  CHECK(mode.stiffness == doctest::Approx(weight.k / weight.m));
  CHECK(mode.damping == doctest::Approx(weight.k_d / weight.m));
}

TEST_CASE("damping alone limits dt too: Verlet and Euler at 2 m/c") {
  const std::vector<Mode> decay{{0, 80}};
  CHECK(dt_crit(scheme("verlet"), decay) == doctest::Approx(2 / 80.0).epsilon(1e-3));
  CHECK(dt_crit(scheme("euler"), decay) == doctest::Approx(2 / 80.0).epsilon(1e-3));
}

TEST_CASE("the stiffness at which a dt breaks is that whose dt_crit it is") {
  const auto modes = extreme_modes(Linearisation(Simulation(taut_sheet(10, 50, 1e-3, "verlet"))), exact_tolerance);
  for (const char* name : {"verlet", "velocity_verlet", "rk4"}) {
    CHECK(stiffness_margin(scheme(name), modes, dt_crit(scheme(name), modes)) == doctest::Approx(1).epsilon(1e-4));
    CHECK(stiffness_margin(scheme(name), modes, 1e-5) > 100);
  }
  CHECK(std::isinf(stiffness_margin(scheme("implicit_euler"), modes, 1)));
}

TEST_CASE("methods break on the taut sheet within 1 % of where they are predicted to; Eulers grow within 5 %") {
  for (const char* name : {"verlet", "velocity_verlet", "rk4"})
    for (const double zeta : {0.0, 0.1}) {
      CAPTURE(name);
      CAPTURE(zeta);
      Preset sheet = taut_sheet(8, 300, 0, name);
      sheet.k_d = damping_for(sheet, zeta);
      CHECK(measure_dt(sheet).ratio() == doctest::Approx(1).epsilon(0.01));
      sheet.dt = 5e-4;
      CHECK(measure_k_s(sheet).ratio() == doctest::Approx(1).epsilon(0.01));
    }
  for (const char* name : {"euler", "improved_euler"})
    for (const double zeta : {0.0, 0.05}) {
      CAPTURE(name);
      Preset sheet = taut_sheet(8, 50, 0, name);
      sheet.k_d = damping_for(sheet, zeta);
      sheet.dt = 0.6 / std::sqrt(8 * sheet.k_s / sheet.m);
      CHECK(measure_growth(sheet).ratio() == doctest::Approx(1).epsilon(0.05));
    }
}

TEST_CASE("in every shape the cloth's own limit lies between the worst-case limit and the one of every shape") {
  test::Random random(7);
  for (int n = 0; n < 60; ++n) {
    CAPTURE(n);
    Preset p = test::quiet_cloth(2 + random.below(5), 2 + random.below(5));
    p.k_s = std::pow(10, random.uniform(0, 4)), p.m = std::pow(10, random.uniform(-5, -2));
    p.k_d = n % 3 == 0 ? 0 : std::sqrt(p.k_s * p.m) * std::pow(10, random.uniform(-3, 0.5));
    p.initial_stretch = random.uniform(0.8, 1.1);
    if (n % 2 == 0) p.pins.mode = Pins::Mode::top_row;
    const State shape = test::crumpled(p, std::uint64_t(n), random.uniform(0.01, 0.8), 0);
    Simulation simulation(p);
    test::load(simulation, shape);
    const Linearisation cloth(simulation);
    if (!(cloth.largest_stiffness(1e-9) > 0)) continue;  // no spring pulls
    const std::vector<Mode> modes = extreme_modes(cloth, exact_tolerance);
    for (const char* method : {"verlet", "velocity_verlet", "rk4", "rkn4", "force_gradient4"}) {
      CAPTURE(method);
      p.integrator = method;
      const double own = dt_crit(scheme(method), modes);
      CHECK(own >= stable_dt(p, method) * (1 - 1e-3));
      CHECK(own <= every_shape_limit(p) * (1 + 2e-3));
    }
  }
}

TEST_CASE("one spring that pulls at a free particle is the shape in which Verlet tolerates most") {
  Preset p = test::quiet_cloth(2, 1);
  p.pins.mode = Pins::Mode::top_row, p.initial_stretch = 1.1;
  const double own = dt_crit(scheme("verlet"), extreme_modes(Linearisation(Simulation(p)), exact_tolerance));
  CHECK(own == doctest::Approx(every_shape_limit(p)).epsilon(2e-3));
  CHECK(own == doctest::Approx(2 * std::sqrt(p.m / p.k_s)).epsilon(1e-4));
}

/// A slack cloth of random size, constants and start that weight pulls at, without damping.
Preset slack_scene(test::Random& random) {
  static constexpr Pins::Mode modes[] = {Pins::Mode::top_row, Pins::Mode::top_corners, Pins::Mode::four_corners,
                                         Pins::Mode::left_column};
  Preset p = test::cloth(4 + random.below(7), 4 + random.below(7));
  p.k_d = 0, p.k_s = std::pow(10, random.uniform(0.5, 3)), p.m = std::pow(10, random.uniform(-4.5, -3));
  p.k_b = random.below(2) * p.k_s * random.uniform(0, 0.5);
  p.pins.mode = modes[random.below(4)];
  p.tilt_deg = random.uniform(0, 90), p.initial_stretch = random.uniform(0.8, 1.05);
  return p;
}

TEST_CASE("below the worst-case limit no undamped slack scene diverges; above the limit of every shape all do") {
  for (const char* method : {"verlet", "velocity_verlet", "rk4"}) {
    CAPTURE(method);
    test::Random random(18);
    for (int n = 0; n < 25; ++n) {
      CAPTURE(n);
      Preset p = slack_scene(random);
      p.integrator = method;
      p.dt = 0.99 * stable_dt(p, method);
      Simulation below(p);
      below.advance(4000);
      CHECK_FALSE(below.divergence().has_value());
      p.dt = 1.02 * every_shape_limit(p);
      Simulation above(p);
      above.advance(4000);
      CHECK(above.divergence().has_value());
    }
  }
}

}  // namespace tyglab::frequency_test
