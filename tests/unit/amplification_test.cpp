// Linear stability read off the schemes' tables, against closed forms, and against the running code.
#include "core/theory/modes.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/support/scenes.h"

namespace tyglab::amplification_test {

double radius(const char* name, double h, double zeta) {
  return spectral_radius(amplification(scheme(name), h, zeta));
}

TEST_CASE("spectral radii have their closed forms") {
  for (const double h : {0.1, 0.7, 1.5}) {
    CHECK(radius("euler", h, 0) == doctest::Approx(std::sqrt(1 + h * h)).epsilon(1e-12));
    CHECK(radius("improved_euler", h, 0) == doctest::Approx(std::sqrt(1 + h * h / 2)).epsilon(1e-12));
    CHECK(radius("verlet", h, 0) == doctest::Approx(1).epsilon(1e-12));
    // |1 + z + z²/2 + z³/6 + z⁴/24| at z = ih: 1 - h⁶/72 + h⁸/576 squared.
    CHECK(radius("implicit_euler", h, 0) == doctest::Approx(1 / std::sqrt(1 + h * h)).epsilon(1e-12));
    CHECK(radius("implicit_midpoint", h, 0) == doctest::Approx(1).epsilon(1e-12));
    CHECK(radius("rk4", h, 0) ==
          doctest::Approx(std::sqrt(1 - std::pow(h, 6) / 72 + std::pow(h, 8) / 576)).epsilon(1e-12));
  }
}

TEST_CASE("where two eigenvalues meet the radius is theirs, though rounding makes the powers vanish") {
  CHECK(radius("verlet", 2, 0) == doctest::Approx(1).epsilon(1e-6));  // both are -1
  const Matrix shifts{2, {0, 1, 0, 0}};
  CHECK(spectral_radius(shifts) == 0);  // nilpotent indeed
}

TEST_CASE("stability limits have their closed forms") {
  for (const double zeta : {0.0, 0.01, 0.3, 2.0}) {
    CAPTURE(zeta);
    const double lagged = 2 * (std::sqrt(1 + zeta * zeta) - zeta);
    CHECK(stability_limit(scheme("verlet"), zeta) == doctest::Approx(lagged).epsilon(1e-6));
    CHECK(stability_limit(scheme("semi_implicit_euler"), zeta) == doctest::Approx(lagged).epsilon(1e-6));
    if (zeta < 1) CHECK(stability_limit(scheme("euler"), zeta) == doctest::Approx(2 * zeta).epsilon(1e-6));
  }
  CHECK(stability_limit(scheme("velocity_verlet"), 0) == doctest::Approx(2).epsilon(1e-4));
  // As docs/integrators.md says them.
  CHECK(stability_limit(scheme("rkn4"), 0) == doctest::Approx(2.59).epsilon(2e-3));
  CHECK(stability_limit(scheme("force_gradient4"), 0) == doctest::Approx(2 * std::sqrt(3.0)).epsilon(1e-4));
  CHECK(stability_limit(scheme("dopri5"), 0) == doctest::Approx(1).epsilon(5e-3));
  CHECK(2 * stability_limit(scheme("dopri5"), 1e3) * 1e3 == doctest::Approx(3.31).epsilon(2e-3));
  CHECK(stability_limit(scheme("rk4"), 0) == doctest::Approx(2 * std::sqrt(2.0)).epsilon(1e-6));
}

TEST_CASE("implicit methods are stable at every dt; fast oscillations stay, or go") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const char* name : {"implicit_euler", "implicit_midpoint", "tr_bdf2"})
    for (const double zeta : {0.0, 0.3}) CHECK(stability_limit(scheme(name), zeta) == infinity);
  CHECK(radius("implicit_midpoint", 1e4, 0) == doctest::Approx(1).epsilon(1e-9));
  CHECK(radius("implicit_euler", 1e4, 0) < 1e-3);
  CHECK(radius("tr_bdf2", 1e4, 0) < 1e-3);  // L-stable
}

TEST_CASE("positions change in a method's last sweep alone, as bodies need it") {
  for (const Scheme& s : schemes())
    for (const Sweep& sweep : s.sweeps)
      for (const Assignment& assignment : sweep.assignments) {
        CAPTURE(std::string(s.name));
        CHECK((assignment.target != vector_x || &sweep == &s.sweeps.back()));
      }
}

TEST_CASE("the tables say what the running code does: a weight on its spring grows or decays as predicted") {
  for (const Scheme& s : schemes())
    for (const double zeta : {0.0, 0.2})
      for (const double h : {0.5, 1.9, 2.5}) {
        CAPTURE(std::string(s.name));
        CAPTURE(zeta);
        CAPTURE(h);
        if (!has_step_limit(s)) continue;
        Preset preset = test::one_weight(std::string(s.name));
        preset.g = 0, preset.v_0 = {0, 0, 0}, preset.offset = 1e-3;
        preset.m = 1, preset.k = 100, preset.k_d = 20 * zeta, preset.dt = h / std::sqrt(preset.k / preset.m);
        const double growth = std::log(radius(s.name.data(), h, zeta));
        // What leaves every bound, or falls under rounding, before it can be measured is left out.
        const int window = int(std::min(40.0, 8 / std::abs(growth)));
        if (window < 12) continue;
        // The envelope of the motion over many steps, by the largest |y| in two windows.
        Simulation simulation(preset);
        const int steps = window / 2;
        double first = 0, second = 0;
        for (int n = 0; n < 2 * window + steps; ++n) {
          if (simulation.advance(1).diverged) break;
          const double y = std::abs(simulation.positions().at(0, 0).y - preset.x_0.y);
          if (n < window) first = std::max(first, y * std::exp(-growth * n));
          if (n >= window + steps) second = std::max(second, y * std::exp(-growth * n));
        }
        CHECK(first > 0);
        if (second > 0) CHECK(std::abs(std::log(second / first)) < 0.7);
      }
}

}  // namespace tyglab::amplification_test
