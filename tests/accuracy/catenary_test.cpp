// A chain of beads on springs between two pins at rest: the discrete elastic catenary.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "tests/support/scenes.h"

namespace tyglab::catenary_test {

struct Point {
  double z, y;
};

/// The chain's beads from its left pin for a horizontal tension H (N): every link carries H, and vertically half of the
/// weight of all beads, less one weight a bead.
std::vector<Point> chain(const Preset& p, double H) {
  const int links = p.rows - 1;
  std::vector<Point> at{{0, 0}};
  for (int n = 0; n < links; ++n) {
    const double V = p.m * p.g * (n - (links - 1) / 2.0);  // upwards on the link's far end
    const double T = std::hypot(H, V), length = p.L + T / p.k_s;
    at.push_back({at.back().z + length * H / T, at.back().y + length * V / T});
  }
  return at;
}

/// That with the pins so far apart.
std::vector<Point> catenary(const Preset& p, double span) {
  double low = 1e-9, high = 1e3;
  for (int n = 0; n < 200; ++n) {
    const double middle = std::sqrt(low * high);
    (chain(p, middle).back().z < span ? low : high) = middle;
  }
  return chain(p, low);
}

TEST_CASE("a chain between two pins hangs in the discrete elastic catenary") {
  for (const double span : {0.7, 1.05}) {  // slack and taut, for a chain of 1 m
    CAPTURE(span);
    for (const auto& [integrator, dt] : {std::pair{"velocity_verlet", 1e-3}, {"tr_bdf2", 1e-2}}) {
      CAPTURE(std::string(integrator));
      Preset preset = test::quiet_cloth(11, 1, integrator);
      preset.L = 0.1, preset.m = 0.01, preset.k_s = 200, preset.k_d = 0.05, preset.g = 9.82, preset.dt = dt;
      preset.tilt_deg = 0, preset.initial_stretch = span;
      preset.pins.mode = Pins::Mode::list;
      preset.pins.list = {{0, 0}, {10, 0}};
      Simulation simulation(preset);
      simulation.advance(int(std::lround(60 / dt)));
      REQUIRE_FALSE(simulation.divergence().has_value());
      const std::vector<Point> wanted = catenary(preset, span);
      double worst = 0;
      for (int i = 0; i <= 10; ++i) {
        const glm::dvec3 at = simulation.positions().at(i, 0) - preset.x_0;
        worst = std::max(worst, glm::length(at - glm::dvec3(0, wanted[i].y, wanted[i].z)));
      }
      CHECK(worst < 1e-7);
    }
  }
}

}  // namespace tyglab::catenary_test
