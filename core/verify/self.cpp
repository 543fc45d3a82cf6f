// The cloth that meets itself: with the guard nothing crosses, in any scene, for a minute.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/analysis/self_crossings.h"
#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

Preset guarded_cloth(int rows, int columns, glm::dvec3 x, double tilt_deg) {
  Preset preset = bending_cloth(rows, columns, "verlet");
  preset.g = g, preset.L = 0.03, preset.m = 4e-4, preset.k_s = 60, preset.k_b = 1, preset.k_d = 0.001;
  preset.x_0 = x, preset.tilt_deg = tilt_deg, preset.dt = 1e-3;
  preset.self = "guard", preset.self_friction = 0.3;
  Body floor;
  floor.shape = Body::Shape::plane, floor.friction = 0.5;
  preset.bodies = {floor};
  return preset;
}

/// Pins these particles, which move as told.
void pin(Preset& preset, std::vector<Pins::Site> sites, Pins::Motion motion) {
  preset.pins.mode = Pins::Mode::list;
  preset.pins.list.insert(preset.pins.list.end(), sites.begin(), sites.end());
  motion.mode = Pins::Mode::list, motion.list = std::move(sites);
  preset.pins.motions.push_back(std::move(motion));
}

std::vector<Pins::Site> row(const Preset& preset, int i, int begin, int end) {
  std::vector<Pins::Site> sites;
  for (int j = begin; j < std::min(end, preset.columns); ++j) sites.push_back({i, j});
  return sites;
}

/// A sheet far from all else, all particles of which move to and fro, and toward its middle.
Preset crumpling(Trial& trial, State& state) {
  Preset preset = guarded_cloth(12, 12, {0, 0, 0}, 90);
  preset.bodies.clear(), preset.g = 0, preset.k_d = 2e-4, preset.dt = 1e-4;
  state = trial.start(preset).read();
  for (std::size_t n = 0; n < state.v.x.size(); ++n) {
    const double phase = 1.7 * double(n);
    state.v.x[n] = 2 * std::sin(phase) - 12 * state.x.x[n], state.v.z[n] = 2 * std::sin(2.3 * phase);
    state.v.y[n] = 2 * std::cos(1.1 * phase) - 12 * (state.x.y[n] + 0.165);
  }
  return preset;
}

void crumpling_momentum(Trial& trial) {
  for (const char* method : {"verlet", "rk4", "dopri5", "implicit_midpoint"}) {
    State state;
    Preset preset = crumpling(trial, state);
    preset.self = "repel", preset.integrator = method, preset.g = g;
    Simulation simulation = trial.start(preset);
    simulation.load(state);
    glm::dvec3 before{0}, after{0};
    const auto add = [&](glm::dvec3& sum) {
      const State& now = simulation.read();
      for (std::size_t n = 0; n < now.v.x.size(); ++n) sum += preset.m * glm::dvec3(now.v.x[n], now.v.y[n], now.v.z[n]);
    };
    add(before);
    double met = 0;
    for (int n = 0; n < 20; ++n) {
      trial.advance(simulation, 100);
      met = std::max(met, simulation.energy().energy.of[force::self]);
    }
    if (!(met > 0)) throw std::runtime_error("no layers have met");
    add(after);
    const glm::dvec3 gained = after - before;
    const double exact = -preset.m * double(state.v.x.size()) * g * simulation.time();
    // What it gains to the sides, none, counts beside what it gains downward.
    for (const double sum : {gained.y, exact + gained.x, exact + gained.z}) trial.compare(exact, sum, method);
    trial.show(simulation);
  }
}

void heap_energy(Trial& trial) {
  constexpr double tilt_deg = 75, from = 0.4;
  for (const char* method : {"verlet", "rk4", "implicit_euler"}) {
    Preset preset = guarded_cloth(13, 13, {0, from, 0}, tilt_deg);
    preset.integrator = method, preset.dt = 2e-4;
    Simulation simulation = trial.start(preset);
    const double middle = from - 6 * preset.L * std::sin(tilt_deg * std::numbers::pi / 180);
    const double exact = preset.m * 169 * g * middle;
    trial.compare(exact, simulation.energy().energy.total(), std::string(method) + ", at the start");
    double least = exact, rise = 0;
    for (int n = 0; n < 100; ++n) {
      trial.advance(simulation, 100);
      const double now = simulation.energy().energy.total();
      rise = std::max(rise, now - least), least = std::min(least, now);
    }
    trial.compare(exact, exact + rise, std::string(method) + ", with its rise");
    trial.show(simulation);
  }
}

/// A minute of it, by Verlet and with a large step by implicit Euler. Around sites that have parted there is no guard.
void stays_apart(Trial& trial, const Preset& preset) {
  constexpr int seconds = 60, looks = 10;  // looks in a second
  for (const char* method : {"verlet", "implicit_euler"}) {
    Preset scene = preset;
    if (scene.integrator != method) scene.integrator = method, scene.dt = 1.0 / 120;
    Simulation simulation = trial.start(scene);
    const auto steps = std::llround(1 / (looks * scene.dt));
    std::int64_t most = 0;
    for (int n = 0; n < seconds * looks; ++n) {
      trial.advance(simulation, steps);
      const Crossings crossings = self_crossings(simulation);
      most = std::max(most, crossings.pairs - crossings.around_sites);
      if (n == looks) trial.show(simulation);
    }
    if (scene.tearing == "split" && simulation.tears().mesh() == nullptr) throw std::runtime_error("nothing has torn");
    trial.compare(0, double(most), method);
  }
}

/// A strip on the floor, one end of which is laid on the other.
void folded_strip(Trial& trial) {
  Preset preset = guarded_cloth(15, 4, {0, 0.005, 0}, 0);
  pin(preset, row(preset, 0, 0, preset.columns),
      {.path = {{0, {0, 0, 0}}, {1, {0, 0.15, 0.15}}, {2, {0, 0.05, 0.3}}, {2.5, {0, 0.02, 0.3}}}});
  stays_apart(trial, preset);
}

/// A sheet that falls on its edge.
void heap(Trial& trial) {
  stays_apart(trial, guarded_cloth(11, 11, {0, 0.35, 0}, 75));
}

/// A strip whose lower end makes four turns.
void four_turns(Trial& trial) {
  Preset preset = guarded_cloth(21, 4, {0, 1.1, 0}, 90);
  preset.initial_stretch = 1.1, preset.bodies.clear();
  pin(preset, row(preset, 0, 0, preset.columns), {.path = {{0, {0, 0, 0}}, {8, {0, -0.1, 0}}}});
  pin(preset, row(preset, preset.rows - 1, 0, preset.columns), {.spin = {0, std::numbers::pi, 0}, .until = 8});
  stays_apart(trial, preset);
}

/// A sheet on the floor, one edge of which is drawn over the rest and beyond.
void over_its_edge(Trial& trial) {
  Preset preset = guarded_cloth(15, 9, {0, 0.005, 0}, 0);
  pin(preset, row(preset, 0, 0, preset.columns),
      {.path = {{0, {0, 0, 0}}, {1, {0, 0.15, 0.1}}, {3, {0, 0.06, 0.8}}, {4, {0, 0.06, 0.8}}}});
  stays_apart(trial, preset);
}

/// A sheet that falls on a ball beside its middle, and slides to the floor.
void off_the_ball(Trial& trial) {
  Preset preset = guarded_cloth(10, 10, {0, 0.45, 0}, 0);
  Body ball;
  ball.c = {0.08, 0.2, 0.05}, ball.r = 0.12, ball.friction = 0.1;
  preset.bodies.push_back(ball);
  stays_apart(trial, preset);
}

/// A curtain whose halves are drawn apart until it tears in two.
void torn_curtain(Trial& trial) {
  Preset preset = guarded_cloth(13, 13, {0, 0.5, 0}, 90);
  preset.tearing = "split", preset.F_max = 0.3, preset.dt = 5e-4, preset.k_d = 0.002;
  for (const bool left : {true, false})
    pin(preset, left ? row(preset, 0, 0, 5) : row(preset, 0, 8, preset.columns),
        {.path = {{0, {0, 0, 0}}, {1, {0, 0, 0}}, {4, {left ? -0.2 : 0.2, 0.03, left ? 0.15 : -0.15}}}});
  stays_apart(trial, preset);
}

}  // namespace

std::span<const Case> self_cases() {
  static constexpr std::string_view formula = "No pair of triangles crosses";
  static constexpr std::string_view source =
      "A. H. Chen et al., Offset Geometric Contact (2025); derived in docs/model.md";
  static constexpr double none = 0.01;
  static constexpr std::array rows{
      Case{"folded_strip", "A strip that is folded",
           "One end of a strip is laid on the other. Pairs of triangles that cross are counted ten times per second, "
           "for "
           "60 s, with Verlet and with implicit Euler at 1/120 s.",
           formula, source, "", none, 0, folded_strip},
      Case{"heap", "A heap",
           "A sheet falls onto the floor on its edge and folds into a heap. Crossings are counted for 60 s, as above.",
           formula, source, "", none, 0, heap},
      Case{
          "four_turns", "A strip with four turns",
          "The lower end of a strip makes four turns, and the strip becomes a rope. Crossings are counted for 60 s, as "
          "above.",
          formula, source, "", none, 0, four_turns},
      Case{"over_its_edge", "A sheet that is drawn over its own edge",
           "One edge of a sheet on the floor is drawn over the rest and beyond it. Crossings are counted for 60 s, as "
           "above.",
           formula, source, "", none, 0, over_its_edge},
      Case{"off_the_ball", "A sheet that slides off a ball",
           "A sheet falls on a ball beside its middle and slides to the floor. Crossings are counted for 60 s, as "
           "above.",
           formula, source, "", none, 0, off_the_ball},
      Case{"torn_curtain", "A curtain that is torn in two",
           "The halves of a curtain's upper edge are drawn apart until it parts. Crossings are counted for 60 s, as "
           "above, but for those around sites that have parted, where no guard acts.",
           formula, source, "", none, 0, torn_curtain},
      Case{"crumpling_momentum", "Momentum of a sheet that crumples",
           "A free sheet is thrown together: its layers push each other off, and gravity alone changes its momentum.",
           "$\\Delta p = -M g t$", "Newton's third law", "N s", 1e-9, 0, crumpling_momentum},
      Case{"heap_energy", "Energy of a sheet that becomes a heap",
           "A sheet falls on its edge, without restitution, and its energy never rises. The energy at the start is "
           "compared with M g h, and with what it rises by in 2 s added.",
           "$E = M g h$, and no rise", "Derived in docs/model.md", "J", 1e-4, 0, heap_energy},
  };
  return rows;
}

}  // namespace tyglab::verify
