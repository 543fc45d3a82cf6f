// Shapes and forces of cloths and chains at rest.
#include <array>
#include <cmath>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

/// A chain of beads that hangs from its top, at its start with springs at rest length.
Preset hung_chain(int beads, const char* method, double dt) {
  Preset preset = quiet_cloth(beads + 1, 1, method);
  preset.pins.mode = Pins::Mode::top_row;
  preset.g = g, preset.L = 0.1, preset.m = 0.01, preset.k_s = 40, preset.k_d = 1, preset.dt = dt;
  return preset;
}

struct Setting {
  const char* method;
  double dt;
};
constexpr Setting resting[]{{"verlet", 1e-3},         {"velocity_verlet", 1e-3}, {"rk4", 1e-3}, {"dopri5", 1e-2},
                            {"implicit_euler", 1e-2}, {"tr_bdf2", 1e-2},         {"vbd", 1e-2}};

void hung_mass(Trial& trial) {
  for (const auto& [method, dt] : resting) {
    const Preset preset = hung_chain(1, method, dt);
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, std::lround(10 / dt));
    trial.compare(preset.m * g / preset.k_s, preset.x_0.y - simulation.position(1, 0).y - preset.L, method);
  }
}

void hung_beads(Trial& trial) {
  constexpr int beads = 10;
  for (const auto& [method, dt] : resting) {
    Preset preset = hung_chain(beads, method, dt);
    preset.iterations = 50, preset.tolerance = 1e-9;
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, std::lround(40 / dt));
    trial.compare(preset.m * g / preset.k_s * beads * (beads + 1) / 2,
                  preset.x_0.y - simulation.position(beads, 0).y - beads * preset.L, method);
  }
}

void weight_on_pins(Trial& trial) {
  for (const Pins::Mode pins : {Pins::Mode::top_corners, Pins::Mode::top_row, Pins::Mode::four_corners}) {
    Preset preset = bending_cloth(9, 9, "implicit_euler");
    preset.g = g, preset.k_d = 0.002, preset.tilt_deg = 85, preset.dt = 0.02;
    preset.pins.mode = pins;
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, 3000);
    double sum = 0;
    int pinned = 0;
    for (int i = 0; i < preset.rows; ++i)
      for (int j = 0; j < preset.columns; ++j)
        if (simulation.pinned(i, j)) sum -= simulation.particle(i, j)["F"].y, ++pinned;
    trial.compare(preset.m * g * 81, sum, std::to_string(pinned) + " pins");
  }
}

void wind(Trial& trial) {
  // Every triangle of a flat sheet at 30° to the vertical.
  Preset preset = quiet_cloth(7, 8, "verlet");
  preset.tilt_deg = 60, preset.W = {0.3, 0.2, 0.6};
  const double turned = 30 * std::acos(-1.0) / 180,
               across = preset.W.y * std::sin(turned) + preset.W.z * std::cos(turned);
  const Simulation simulation = trial.start(preset);
  trial.show(simulation);
  glm::dvec3 sum(0);
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 8; ++j) sum += simulation.particle(i, j)["F_wind"];
  const double triangles = 2 * 6 * 7;
  trial.compare(0, sum.x, "x");
  trial.compare(triangles * across * std::sin(turned), sum.y, "y");
  trial.compare(triangles * across * std::cos(turned), sum.z, "z");
}

struct Point {
  double z, y;
};

/// The beads of a chain that hangs at rest between two pins at one height, from its left pin.
std::vector<Point> hanging_beads_of(Trial& trial, Preset preset, double span) {
  const int links = preset.rows - 1;
  preset.tilt_deg = 0, preset.initial_stretch = span / (links * preset.L);
  preset.pins.mode = Pins::Mode::list, preset.pins.list = {{0, 0}, {links, 0}};
  Simulation simulation = trial.start(preset);
  trial.advance(simulation, std::lround(60 / preset.dt));
  std::vector<Point> at;
  for (int i = 0; i <= links; ++i) {
    const glm::dvec3 bead = simulation.position(i, 0) - preset.x_0;
    at.push_back({bead.z, bead.y});
  }
  return at;
}

/// The beads of such a chain from its left pin for a horizontal tension H (N): every link carries H, and vertically
/// half of the weight of all beads, less one weight a bead.
std::vector<Point> beads_of(const Preset& p, double H) {
  const int links = p.rows - 1;
  std::vector<Point> at{{0, 0}};
  for (int n = 0; n < links; ++n) {
    const double V = p.m * g * (n - (links - 1) / 2.0), T = std::hypot(H, V), length = p.L + T / p.k_s;
    at.push_back({at.back().z + length * H / T, at.back().y + length * V / T});
  }
  return at;
}

/// The horizontal tension, N, at which a chain's far pin is that far away.
double tension_at(double span, const std::function<double(double)>& reach) {
  double low = 1e-9, high = 1e3;
  for (int n = 0; n < 200; ++n) {
    const double middle = std::sqrt(low * high);
    (reach(middle) < span ? low : high) = middle;
  }
  return low;
}

void catenary_of_beads(Trial& trial) {
  for (const double span : {0.7, 1.05})
    for (const auto& [method, dt] : {Setting{"velocity_verlet", 1e-3}, {"tr_bdf2", 1e-2}}) {
      Preset preset = quiet_cloth(11, 1, method);
      preset.L = 0.1, preset.m = 0.01, preset.k_s = 200, preset.k_d = 0.05, preset.g = g, preset.dt = dt;
      const double H = tension_at(span, [&](double tension) { return beads_of(preset, tension).back().z; });
      const std::vector<Point> exact = beads_of(preset, H), measured = hanging_beads_of(trial, preset, span);
      for (std::size_t i = 1; i + 1 < exact.size(); ++i) {
        const std::string bead = std::string(method) + ", bead " + std::to_string(i);
        trial.compare(exact[i].y, measured[i].y, bead + ", y"), trial.compare(exact[i].z, measured[i].z, bead + ", z");
      }
    }
}

void catenary(Trial& trial) {
  // 1 m, 0.1 kg, 20 N of stiffness over a gap of 0.7 m.
  constexpr double weight = 0.1 * g, stiffness = 20, span = 0.7;
  const double V = weight / 2;
  const double H = tension_at(
      span, [&](double tension) { return tension / stiffness + 2 * tension / weight * std::asinh(V / tension); });
  const double sag = V / (4 * stiffness) + H / weight * (std::sqrt(1 + V * V / (H * H)) - 1);
  trial.refine(2, sag, {1.0 / 8, 1.0 / 16, 1.0 / 32}, [&](double h) {
    Preset preset = quiet_cloth(int(std::lround(1 / h)) + 1, 1, "implicit_euler");
    preset.L = h, preset.m = 0.1 * h, preset.k_s = stiffness / h, preset.k_d = 0.05, preset.g = g, preset.dt = 0.05;
    return -hanging_beads_of(trial, preset, span)[std::size_t(preset.rows / 2)].y;
  });
}

}  // namespace

std::span<const Case> statics_cases() {
  static constexpr std::array rows{
      Case{"hung_mass", "Stretch of a spring under a weight", "A damped mass hangs at rest from one spring.",
           "$\\Delta L = m g/k_s$", "R. Hooke; report (2.5)", "m", 1e-9, 0, hung_mass},
      Case{"hung_beads", "Stretch of a hanging chain",
           "A chain of 10 beads hangs at rest: each spring carries the beads below it.",
           "$\\Delta L = \\frac{m g}{k_s}\\,\\frac{N(N+1)}2$", "Sum of report (2.5)", "m", 1e-7, 0, hung_beads},
      Case{"weight_on_pins", "Pins carry the weight",
           "A cloth at rest, hung in three ways: the forces on its pins add up to its weight.",
           "$\\sum F_{pin} = R\\,C\\,m\\,g$", "Balance of forces", "N", 3e-7, 0, weight_on_pins},
      Case{"wind", "Wind on a flat sheet",
           "Wind blows at a flat tilted sheet: the sum of all forces has a closed form.",
           "$F = 2(R-1)(C-1)\\,N(N\\cdot W)$", "Report (2.16)", "N", 1e-12, 0, wind},
      Case{"catenary_of_beads", "Chain between two pins",
           "A damped chain of 9 beads hangs between pins nearer or farther apart than its length: the place of each "
           "bead.",
           "each link carries the tension $(H, V_n)$ and has the length $L + |T_n|/k_s$",
           "Balance of forces of each bead", "m", 1e-6, 0, catenary_of_beads},
      Case{"catenary", "Catenary",
           "The sag of finer and finer chains of one length, mass and stiffness nears that of the elastic catenary.",
           "$\\frac{V}{4EA}\\,l + \\frac{H}{w}\\left(\\sqrt{1 + V^2/H^2} - 1\\right)$, $V = wl/2$, span "
           "$\\frac{H l}{EA} + \\frac{2H}{w}\\,\\mathrm{arsinh}\\frac VH$",
           "H. M. Irvine, Cable Structures (1981)", "m", 1e-3, 0.15, catenary},
  };
  return rows;
}

}  // namespace tyglab::verify
