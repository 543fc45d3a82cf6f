// Cases of cloth that parts.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <stdexcept>
#include <vector>

#include "core/analysis/area.h"
#include "core/cloth/mesh.h"
#include "core/verify/gallery.h"
#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

Preset parting_cloth(int rows, int columns, std::string_view integrator) {
  Preset preset = bending_cloth(rows, columns, integrator);
  preset.tearing = "split", preset.k_d = 0.002, preset.dt = 2e-4;
  return preset;
}

/// Mass, and mass times place and velocity, of the particles for which `counts` holds.
struct Sums {
  double mass = 0;
  glm::dvec3 x{0}, v{0};
};
template <class Counts>
Sums sum_of(Simulation& simulation, const Counts& counts) {
  const State& state = simulation.read();
  const Tears& tears = simulation.tears();
  Sums sum;
  for (int n = 0; n < tears.particles(); ++n) {
    if (!counts(n)) continue;
    const auto p = std::size_t(n);
    const double m = simulation.preset().m * tears.share(n);
    sum.mass += m;
    sum.x += m * glm::dvec3(state.x.x[p], state.x.y[p], state.x.z[p]);
    sum.v += m * glm::dvec3(state.v.x[p], state.v.y[p], state.v.z[p]);
  }
  return sum;
}

void cut_piece(Trial& trial) {
  constexpr int rows = 13, columns = 9, at = 6;
  for (const char* method : {"verlet", "rk4", "dopri5"}) {
    Preset preset = parting_cloth(rows, columns, method);
    preset.g = g, preset.pins.mode = Pins::Mode::top_row, preset.tilt_deg = 60;
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, 1000);
    std::vector<SpringSite> across;
    across.reserve(columns);
    for (int j = 0; j < columns; ++j) across.push_back({1, at, j});
    simulation.apply(edit::CutSprings{across});
    if (simulation.tears().mesh() == nullptr) throw std::runtime_error("nothing has parted");
    const auto below = [&](int n) {
      const int i = simulation.tears().site(n).i;
      return i > at || (i == at && (simulation.tears().mesh()->cells_of(n) & Mesh::down_left) != 0) ||
             (i == at && (simulation.tears().mesh()->cells_of(n) & Mesh::down_right) != 0);
    };
    const Sums before = sum_of(simulation, below);
    const double t = 0.25;
    trial.advance(simulation, std::llround(t / preset.dt));
    const Sums after = sum_of(simulation, below);
    const double exact = before.v.y / before.mass * t - g * t * t / 2;
    trial.compare(exact, (after.x.y - before.x.y) / before.mass, method);
    trial.show(trial.start(preset));  // lines over the cuts would be none of its threads
  }
}

void torn_momentum(Trial& trial) {
  constexpr int rows = 12, columns = 14;
  for (const char* method : {"verlet", "rk4", "dopri5"}) {
    Preset preset = parting_cloth(rows, columns, method);
    preset.g = g, preset.F_max = 0.3;
    State state = start_state(preset);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const auto p = std::size_t(i * columns + j);
        // A blow in the middle, which tears it.
        const double far = (i - 5.5) * (i - 5.5) + (j - 6.5) * (j - 6.5);
        state.v.z[p] = 12 * std::exp(-far / 4), state.v.x[p] = 0.1 * i;
      }
    Simulation simulation = trial.start(preset);
    simulation.load(state);
    const auto all = [](int) { return true; };
    const Sums before = sum_of(simulation, all);
    trial.advance(simulation, 800);
    const Sums after = sum_of(simulation, all);
    if (simulation.tears().particles() == rows * columns) throw std::runtime_error("nothing has torn");
    const double exact = -rows * columns * preset.m * g * simulation.time();
    const glm::dvec3 gained = after.v - before.v;
    // What it gains to the sides, none, counts beside what it gains downward.
    for (const double sum : {gained.y, exact + gained.x, exact + gained.z}) trial.compare(exact, sum, method);
    trial.show(trial.start(preset));  // lines over the cuts would be none of its threads
  }
}

void split_energy(Trial& trial) {
  constexpr int rows = 11, columns = 12;
  Preset preset = quiet_cloth(rows, columns, "verlet");
  preset.tearing = "split", preset.initial_stretch = 1.2;
  const double straight = rows * (columns - 1) + columns * (rows - 1), diagonal = 2 * (rows - 1) * (columns - 1);
  const double longer = 0.2 * preset.L;
  const double exact = preset.k_s / 2 * longer * longer * (straight + 2 * diagonal);
  Simulation simulation = trial.start(preset);
  // Two cuts that cross, one of them with corners.
  std::vector<SpringSite> springs;
  for (int i = 1; i < 9; ++i) springs.push_back({0, i, 3 + i / 3}), springs.push_back({1, 5, i + 1});
  simulation.apply(edit::CutSprings{springs});
  if (simulation.tears().particles() == rows * columns) throw std::runtime_error("nothing has parted");
  trial.compare(exact, simulation.energy().energy.of[force::stretch]);
  trial.show(simulation);  // nothing has moved
}

void split_area(Trial& trial) {
  constexpr int rows = 11, columns = 12;
  Preset preset = quiet_cloth(rows, columns, "verlet");
  preset.tearing = "split", preset.initial_stretch = 1.2, preset.dt = 1e-4;
  Simulation simulation = trial.start(preset);
  std::vector<SpringSite> springs;
  for (int i = 1; i < 9; ++i) springs.push_back({0, i, 3 + i / 3}), springs.push_back({1, 5, i + 1});
  simulation.apply(edit::CutSprings{springs});
  if (simulation.tears().particles() == rows * columns) throw std::runtime_error("nothing has parted");
  trial.compare((rows - 1) * (columns - 1) * std::pow(1.2 * preset.L, 2), cloth_area(simulation));
  trial.show(simulation);  // nothing has moved
}

}  // namespace

std::span<const Case> tearing_cases() {
  static constexpr std::array rows{
      Case{
          "cut_piece", "A piece that is cut off",
          "A swinging cloth is cut across: the center of mass of what is cut off falls freely, copies with their share "
          "of the mass included.",
          "$\\Delta y = v t - \\tfrac12 g t^2$", "Newton's second law", "m", 1e-9, 0, cut_piece},
      Case{"torn_momentum", "Momentum of a cloth that tears",
           "A blow tears a free cloth, which parts at dozens of sites: gravity alone changes its momentum.",
           "$\\Delta p = -M g t$", "Newton's third law", "N s", 1e-9, 0, torn_momentum},
      Case{
          "split_energy", "Energy of a cloth that is cut",
          "A stretched sheet is cut along two lines that cross: the halves of each spring hold together what the whole "
          "held.",
          "$U = \\tfrac12 k_s (0.2 L)^2 (n_{straight} + 2\\,n_{diagonal})$", "Derived in docs/model.md", "J", 1e-12, 0,
          split_energy},
      Case{"split_area", "Area of a cloth that is cut",
           "The same sheet has the area of all its triangles, none of which is lost.", "$A = (R - 1)(C - 1)(1.2 L)^2$",
           "Derived in docs/model.md", "m²", 1e-12, 0, split_area},
  };
  return rows;
}

}  // namespace tyglab::verify
