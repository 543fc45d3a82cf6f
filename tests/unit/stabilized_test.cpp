// Runge-Kutta-Chebyshev: its tables against closed forms, and what it chooses.
#include "core/integrators/stabilized.h"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "core/theory/modes.h"
#include "tests/support/scenes.h"

namespace tyglab::stabilized_test {

using Complex = std::complex<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();

const Scheme& rkc2() {
  return scheme("rkc2");
}

TEST_CASE("R(z) is that of second order, and the tables make steps of it") {
  for (const StageTable& table : rkc2().tables) {
    CAPTURE(table.stages);
    CHECK(int(table.sweeps.size()) == table.stages + 1);
    for (const Complex z : {Complex(-1e-3, 0), Complex(0, 1e-3), Complex(-7e-4, 7e-4)})
      CHECK(std::abs(rkc2_growth(table.stages, z) - std::exp(z)) < 0.2 * std::pow(std::abs(z), 3));
    Scheme one = rkc2();
    one.sweeps = table.sweeps;
    for (const double zeta : {0.0, 0.3, 1.0, 4.0})
      for (const double h : {0.1, 0.9, 2.0}) {
        CAPTURE(zeta);
        CAPTURE(h);
        const Complex root = std::sqrt(Complex(zeta * zeta - 1));
        double largest = 0;
        for (const Complex lambda : {-zeta + root, -zeta - root})
          largest = std::max(largest, std::abs(rkc2_growth(table.stages, h * lambda)));
        // Where both roots are one, the matrix has no two eigenvectors: its powers tell less of it.
        CHECK(spectral_radius(amplification(one, h, zeta)) ==
              doctest::Approx(largest).epsilon(zeta == 1 ? 1e-5 : 1e-9));
      }
  }
}

TEST_CASE("each number of stages is stable as far as its table says, and little farther") {
  for (const StageTable& table : rkc2().tables) {
    CAPTURE(table.stages);
    const double s = table.stages;
    CHECK(table.reach == doctest::Approx(2.0 / 3 * (s * s - 1) * (1 - 4.0 / 195)).epsilon(3e-3));
    constexpr int points = 4000;
    double most = 0, in_disc = 0;
    for (int n = 1; n <= points; ++n) {
      most = std::max(most, std::abs(rkc2_growth(table.stages, -table.reach * n / points)));
      const Complex turn = std::polar(1.0, std::numbers::pi * n / points);
      in_disc = std::max(in_disc, std::abs(rkc2_growth(table.stages, table.disc * (turn - 1.0))));
    }
    CHECK(most <= 1);
    CHECK(in_disc <= 1 + 1e-12);
    // An odd number of stages reaches a little farther.
    CHECK(std::abs(rkc2_growth(table.stages, -(table.stages % 2 == 0 ? 1.02 : 1.25) * table.reach)) > 1);
    double beyond = 0;
    for (int n = 1; n <= points; ++n)
      beyond = std::max(
          beyond, std::abs(rkc2_growth(table.stages,
                                       1.12 * table.disc * (std::polar(1.0, std::numbers::pi * n / points) - 1.0))));
    CHECK(beyond > 1);
  }
}

TEST_CASE("steps have as many stages as their length asks for, and are as long as pays") {
  const Scheme& method = rkc2();
  const Spectrum heavy{1000, 10, 100};  // real to -1000, complex within |λ + 10| <= 10
  CHECK(method.tables[table_for(method, heavy, 1e-3)].stages == 2);
  for (const double h : {0.01, 0.05, 0.1}) {
    CAPTURE(h);
    const std::size_t n = table_for(method, heavy, h);
    CHECK(method.tables[n].reach >= 1000 * h);
    CHECK(method.tables[n].disc >= 10 * h);
    CHECK((n == 0 || method.tables[n - 1].reach < 1000 * h || method.tables[n - 1].disc < 10 * h));
  }
  const double longest = longest_step(method, heavy);
  CHECK(longest > 0.2);
  CHECK(longest <= 0.258);
  // Without stiffness only the reach counts, without damping only what hardly grows; with neither, nothing does.
  CHECK(longest_step(method, {1000, 0, 0}) == doctest::Approx(method.tables.back().reach / 1000));
  CHECK(longest_step(method, {100, infinity, 100}) == doctest::Approx(0.5 / 100));
  CHECK(method.tables[table_for(method, {100, infinity, 100}, 0.5 / 100)].stages == 2);
  CHECK(longest_step(method, {}) == infinity);
  CHECK(longest_step(method, any_spectrum(test::quiet_cloth(3, 3))) > 0);
}

TEST_CASE(
    "a heavily damped cloth costs rkc2 a fraction of dopri5's evaluations; stability is said to limit its steps") {
  Preset preset = test::cloth(12, 12, "rkc2");
  preset.k_d = 0.14, preset.k_b = 0, preset.dt = 0.02, preset.tolerance = 1e-4;
  const auto inner = [&](const char* method) {
    preset.integrator = method;
    Simulation simulation(preset);
    simulation.advance(50);
    CHECK_FALSE(simulation.divergence().has_value());
    return simulation.engine().inner_steps();
  };
  const InnerSteps own = inner("rkc2"), other = inner("dopri5");
  CHECK(own.force_evaluations * 5 < other.force_evaluations);
  CHECK(double(own.by_stability) > 0.8 * double(own.accepted));
  CHECK(double(own.rejected) < 0.05 * double(own.accepted));
  CHECK(own.too_short == 0);
}

TEST_CASE("a change of damping or stiffness changes the stages of the steps that follow") {
  Preset preset = test::cloth(6, 6, "rkc2");
  preset.k_d = 0.2, preset.k_b = 0, preset.dt = 0.01, preset.tolerance = 1e-3;
  Simulation simulation(preset);
  simulation.advance(20);
  for (const auto& [k_s, k_d] :
       {std::pair{50.0, 2.0}, {5e3, 2.0}, {50.0, 0.002}, {50.0, 0.0}, {0.0, 0.0}, {50.0, 0.5}}) {
    CAPTURE(k_s);
    CAPTURE(k_d);
    preset.k_s = k_s, preset.k_d = k_d;
    simulation.apply(edit::Change{preset});
    CHECK_FALSE(simulation.advance(10).diverged);
    CHECK(test::all_finite(simulation.read()));
  }
}

}  // namespace tyglab::stabilized_test
