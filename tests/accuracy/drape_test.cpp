// Without bending springs every energy of the cloth is convex: whatever method brings it to rest, it hangs the same.
#include <doctest/doctest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/cloth/lattice.h"
#include "tests/support/scenes.h"

namespace tyglab::drape_test {

/// Stretch and gravity, J.
double energy(const Preset& preset, const State& state) {
  const Lattice lattice{preset.rows, preset.columns};
  double sum = 0;
  for (int i = 0; i < preset.rows; ++i)
    for (int j = 0; j < preset.columns; ++j) {
      const std::size_t p = std::size_t(i) * preset.columns + j;
      sum += preset.m * preset.g * state.x.y[p];
      for (int d = 0; d < stretch_directions; ++d) {
        if (!lattice.has_spring(d, i, j)) continue;
        const std::size_t q = std::size_t(i + directions[d].di) * preset.columns + j + directions[d].dj;
        const double stretch =
            glm::length(test::position(state, p) - test::position(state, q)) - directions[d].rest * preset.L;
        if (stretch > 0) sum += preset.k_s * stretch * stretch / 2;
      }
    }
  return sum;
}

/// Hung by its upper corners, heavily damped, at rest after some seconds.
State drape(const std::string& integrator, double dt) {
  Preset preset = test::cloth(5, 6, integrator);
  preset.k_b = 0, preset.k_d = 0.02, preset.dt = dt;
  preset.tolerance = 1e-9, preset.iterations = 20;
  Simulation simulation(preset);
  simulation.advance(int(std::lround(20 / dt)));
  return simulation.read();
}

TEST_CASE("with k_b = 0 every damped method comes to rest in the same drape") {
  Preset preset = test::cloth(5, 6);
  preset.k_b = 0;
  const State first = drape("velocity_verlet", 5e-4);
  const double least = energy(preset, first), scale = preset.m * preset.g * preset.L;
  for (const auto& [integrator, dt] : {std::pair{"verlet", 5e-4},
                                       {"rk4", 5e-4},
                                       {"implicit_euler", 1e-2},
                                       {"tr_bdf2", 1e-2},
                                       {"dopri5", 1e-2},
                                       {"projective_dynamics", 1e-2},
                                       {"vbd", 1e-2},
                                       {"xpbd", 5e-4}}) {
    CAPTURE(std::string(integrator));
    const State state = drape(integrator, dt);
    CHECK(std::abs(energy(preset, state) - least) < 1e-6 * scale);
    double worst = 0;
    for (std::size_t p = 0; p < state.x.x.size(); ++p)
      worst = std::max(worst, glm::length(test::position(state, p) - test::position(first, p)));
    CHECK(worst < 1e-4 * preset.L);
  }
}

}  // namespace tyglab::drape_test
