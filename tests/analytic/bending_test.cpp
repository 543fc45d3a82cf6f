// The bending rigidity B against the elastica and the plate: what `tyglab verify` does not show
// (core/verify/bending.cpp).
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "core/forces/force.h"
#include "core/verify/rest.h"
#include "tests/support/scenes.h"

namespace tyglab::bending_test {

/// How far the end of a clamped strip of 1 m drops under its own weight, where q·(1 m)³/B is G, m. Two pinned rows
/// clamp it: it begins in the middle of their edge and ends half a cell beyond the last particle, which stands for one.
double drop(int edges, double G, bool threads_push) {
  Preset preset = test::quiet_cloth(edges + 1, 1);
  preset.L = 1.0 / edges, preset.m = 0.01 / edges, preset.g = 9.82;
  const double q = preset.m * preset.g / preset.L, width = preset.L;
  preset.B = q / G / width, preset.k_s = 1e6;
  verify::Positions x;
  for (int i = 0; i <= edges; ++i) x.push_back({0, i < 2 ? 0 : -1e-3 * i * i * preset.L * preset.L, i * preset.L});
  verify::RestEnergy energy(preset, 2, threads_push);
  verify::find_rest(energy, x);
  const std::size_t last = std::size_t(edges);
  return -(x[last].y + preset.L / 2 * glm::normalize(x[last] - x[last - 1]).y);
}

// Of θ'' = -G (1 - s) cos θ, θ(0) = 0, θ'(1) = 0, by Runge-Kutta's method with 4,000 steps.
struct Elastica {
  double G, drop, within;
};
constexpr Elastica elastica[]{{1, 0.123471, 5e-4}, {10, 0.700200, 5e-4}, {100, 0.937523, 5e-4}, {1000, 0.981141, 3e-3}};

TEST_CASE("a clamped strip of 32 edges whose threads keep their length drops as the elastica") {
  for (const auto& [G, exact, within] : elastica) {
    CAPTURE(G);
    CHECK(std::abs(drop(32, G, true) - exact) < within);
  }
}

// The report's springs do not push: where the moment contracts a thread more than the weight stretches it, the cloth is
// shorter than the elastica, on every lattice.
TEST_CASE("a clamped strip of springs that only pull is shorter where the moment outweighs the tension") {
  for (const int edges : {32, 128})
    CHECK(drop(edges, 10, false) - elastica[1].drop == doctest::Approx(5.8e-3).epsilon(0.1));
}

TEST_CASE("with twist = 0 a cloth bends half as stiffly onto a cylinder at 45° to its threads") {
  Preset preset = test::quiet_cloth(40, 40);
  preset.B = 1e-4, preset.twist = 0;
  const double R = 12 * preset.L;
  const auto x_of = [&](int i, int j) {
    const double along = preset.L * (j - i) / std::numbers::sqrt2, across = preset.L * (j + i) / std::numbers::sqrt2;
    return glm::dvec3(R * std::sin(along / R), across, R * std::cos(along / R));
  };
  double energy = 0;
  for (const Stencil& stencil : force::rigidity.stencils(preset))
    for (int i = 10; i < 30; ++i)
      for (int j = 10; j < 30; ++j) {
        ForceAction action;
        force::rigidity.act(preset, stencil, points_of(stencil, i, j, x_of, x_of), action);
        energy += action.energy;
      }
  CHECK(energy / (400 * preset.L * preset.L) / (preset.B / 4 / (R * R)) == doctest::Approx(1).epsilon(0.005));
}

}  // namespace tyglab::bending_test
