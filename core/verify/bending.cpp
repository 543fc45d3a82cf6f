// The rigidity B against the elastica and the plate.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numbers>
#include <string>

#include "core/forces/force.h"
#include "core/model/notation.h"
#include "core/theory/advice.h"
#include "core/verify/rest.h"
#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

using std::numbers::pi;

/// A strip of 1 m of so many edges. Two pinned rows clamp it: it begins in the middle of their edge.
Preset strip(int edges, int columns) {
  Preset preset = quiet_cloth(edges + 1, columns, "implicit_euler");
  preset.L = 1.0 / edges, preset.m = 0.01 / edges, preset.k_s = 1e6;
  preset.pins.mode = Pins::Mode::list;
  for (int j = 0; j < columns; ++j) preset.pins.list.push_back({0, j}), preset.pins.list.push_back({1, j});
  return preset;
}

/// The drop of a strip of 1 m: φ'' = G r sin φ for the angle φ to the vertical at the distance r from its free end,
/// φ'(0) = 0, φ(1) = π/2, by Runge-Kutta's method and shooting from the free end, where φ may be very small.
double elastica_drop(double G) {
  struct Bend {
    double phi, turn, drop;
  };
  const auto clamp = [&](double phi) {
    constexpr int steps = 4000;
    constexpr double h = 1.0 / steps;
    const auto slope = [&](double r, const Bend& at) {
      return Bend{at.turn, G * r * std::sin(at.phi), std::cos(at.phi)};
    };
    const auto moved = [](const Bend& from, double by, const Bend& along) {
      return Bend{from.phi + by * along.phi, from.turn + by * along.turn, from.drop + by * along.drop};
    };
    Bend at{phi, 0, 0};
    for (int n = 0; n < steps && at.phi < pi / 2; ++n) {  // beyond, it would swing back
      const double r = n * h;
      const Bend a = slope(r, at), b = slope(r + h / 2, moved(at, h / 2, a)), c = slope(r + h / 2, moved(at, h / 2, b)),
                 d = slope(r + h, moved(at, h, c));
      at = moved(moved(moved(moved(at, h / 6, a), h / 3, b), h / 3, c), h / 6, d);
    }
    return at;
  };
  // Over decades of φ at the free end: the more it has there, the more at the clamp.
  const double decades =
      bisect(1, 20, 1e14, [&](double of) { return clamp(std::pow(10, of - 20) * pi / 2).phi < pi / 2; });
  return clamp(std::pow(10, decades - 20) * pi / 2).drop;
}

/// Where particle i of a strip starts that is not quite straight behind its clamp.
glm::dvec3 sagging(int i, double L) {
  return {0, i < 2 ? 0 : -1e-3 * i * i * L * L, i * L};
}

/// The strip's load such that q·(1 m)³/B is G.
void load_strip(Preset& preset, double G) {
  preset.g = g, preset.B = preset.m * g / (preset.L * preset.L) / G;
}

/// How far the end is below the clamp: the last particle stands for a cell, so it is half of one beyond it.
double drop_of(const Preset& preset, glm::dvec3 before, glm::dvec3 last) {
  return -(last.y + preset.L / 2 * glm::normalize(last - before).y);
}

/// A strip at rest, of which the first `fixed` particles are clamped.
void show(const Trial& trial, const Preset& preset, const Positions& x, std::size_t fixed) {
  const auto at = [&](int i, int j) { return std::size_t(i * preset.columns + j); };
  trial.show(
      lattice_of(preset), [&](int i, int j) { return x[at(i, j)]; }, [&](int i, int j) { return at(i, j) < fixed; });
}

void elastica(Trial& trial) {
  const auto drop = [&](double G, double h) {
    const int edges = int(std::lround(1 / h));
    Preset preset = strip(edges, 1);
    load_strip(preset, G);
    preset.k_s = 1e6 * edges / 32;  // of one stiffness per length
    Positions x;
    for (int i = 0; i <= edges; ++i) x.push_back(sagging(i, h));
    RestEnergy energy(trial.scene(preset), 2, true);
    find_rest(energy, x, [&] { trial.look(); });
    show(trial, preset, x, 2);
    return drop_of(preset, x[x.size() - 2], x.back());
  };
  for (const double G : {1.0, 10.0, 100.0})
    trial.refine(
        2, elastica_drop(G), {1.0 / 16, 1.0 / 32, 1.0 / 64}, [&](double h) { return drop(G, h); },
        "qL³/B = " + short_number(G));
  // Of which strips are too coarse to show their order: it hangs down within a few edges.
  trial.compare(elastica_drop(1000), drop(1000, 1.0 / 64), "qL³/B = 1000");
}

void strip_of_springs(Trial& trial) {
  constexpr int edges = 64;
  for (const double G : {1.0, 100.0}) {
    Preset preset = strip(edges, 1);
    preset.x_0 = {0, 0, 0}, preset.tilt_deg = 0, preset.k_d = 1e-3, preset.dt = 0.1;
    load_strip(preset, G);
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, 200);
    trial.compare(elastica_drop(G), drop_of(preset, simulation.position(edges - 1, 0), simulation.position(edges, 0)),
                  "qL³/B = " + short_number(G));
  }
}

void end_load(Trial& trial) {
  // A force of 4 B/L² on the end of a weightless strip: the drop and the shortening of its end.
  const auto end = [&](int edges) {
    Preset preset = strip(edges, 1);
    preset.L = 1 / (edges - 0.5);  // from the middle of the clamped edge to the last particle
    preset.g = 0, preset.B = 1e-2 / preset.L;
    Preset scene = trial.scene(preset);
    Positions x;
    for (int i = 0; i <= edges; ++i) x.push_back(sagging(i, preset.L));
    RestEnergy energy(scene, 2, true, {0, -4e-2, 0});
    find_rest(energy, x, [&] { trial.look(); });
    show(trial, preset, x, 2);
    return glm::dvec2(-x.back().y, 1 - (x.back().z - preset.L / 2));
  };
  const glm::dvec2 coarse = end(16), fine = end(32);
  trial.compare(0.66996, fine.x, "drop");
  trial.compare(0.32894, fine.y, "shortening");
  trial.converges(2, {error_of(0.66996, coarse.x), error_of(0.66996, fine.x)}, "drop");
}

void rest_curvature(Trial& trial) {
  // Three columns, the middle one with a neighbor on both sides; its slowest motion is damped critically.
  const double kappa = 3;
  const auto rise = [&](double h) {
    const int edges = int(std::lround(1 / h));
    Preset preset = strip(edges, 3);
    preset.integrator = "verlet", preset.x_0 = {0, 0, 0}, preset.tilt_deg = 0, preset.k_s = 1e4;
    preset.k_d = 0.05 * std::sqrt(edges / 32.0), preset.B = 0.02, preset.kappa_warp = kappa;
    preset.dt = stable_dt(preset, "verlet");
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, std::llround(20 / preset.dt));
    return -drop_of(preset, simulation.position(edges - 1, 1), simulation.position(edges, 1));
  };
  trial.refine(2, (1 - std::cos(kappa)) / kappa, {1.0 / 8, 1.0 / 16, 1.0 / 32}, rise);
}

void isotropy(Trial& trial) {
  Preset preset = quiet_cloth(40, 40, "verlet");
  preset.B = 1e-4;
  const Preset scene = trial.scene(preset);
  const double R = 12 * preset.L;
  for (const double degrees : {0.0, 15.0, 30.0, 45.0}) {
    const double angle = degrees * pi / 180;
    const auto x_of = [&](int i, int j) {
      const double along = preset.L * (j * std::cos(angle) - i * std::sin(angle));
      const double across = preset.L * (j * std::sin(angle) + i * std::cos(angle));
      return glm::dvec3(R * std::sin(along / R), across, R * std::cos(along / R));
    };
    trial.show(lattice_of(scene), x_of, [](int, int) { return false; });
    double energy = 0;
    for (const Stencil& stencil : force::rigidity.stencils(scene))
      for (int i = 10; i < 30; ++i)
        for (int j = 10; j < 30; ++j) {
          ForceAction action;
          force::rigidity.act(scene, stencil, points_of(stencil, i, j, x_of, x_of), action);
          energy += action.energy;
        }
    trial.compare(preset.B / (2 * R * R), energy / (400 * preset.L * preset.L), std::to_string(int(degrees)) + "°");
  }
}

/// Whether a strip of 1 m that stands on edge keeps its plane under its own weight: its energy has no direction out of
/// the plane in which it falls.
bool stays_upright(Trial& trial, const Preset& preset) {
  Positions x;
  for (int i = 0; i < preset.rows; ++i)
    for (int j = 0; j < preset.columns; ++j) x.push_back({0, -j * preset.L, i * preset.L});
  const std::size_t fixed = 2 * std::size_t(preset.columns);
  RestEnergy energy(preset, fixed, true);
  find_rest(energy, x, [&] { trial.look(); });
  show(trial, preset, x, fixed);
  energy.evaluate(x, true);
  const std::size_t n = x.size() - fixed;
  std::vector<double> out_of_plane(n * n);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b) out_of_plane[a * n + b] = energy.hessian()[3 * a * (3 * n) + 3 * b];
  return positive_definite(std::move(out_of_plane), n);
}

void lateral_buckling(Trial& trial) {
  for (const double twist : {1.0, 0.25}) {
    // The load q L³ in units of √(EI C): each of two columns stands for a part L of the width w, and the twist φ per
    // length of the cells between them has the energy twist·B w φ² = ½ C φ².
    const auto load = [&](int edges) {
      Preset preset = strip(edges, 2);
      preset.k_s = 2e3, preset.B = 1e-3, preset.twist = twist;
      const double bends = preset.B * 2 * preset.L, twists = 2 * twist * preset.B * preset.L;
      return bisect(8, 20, 1e3, [&](double of) {
        Preset loaded = preset;
        loaded.g = of * std::sqrt(bends * twists) * preset.L / (2 * preset.m);
        return stays_upright(trial, trial.scene(loaded));
      });
    };
    // The clamp holds half a cell more against twist than against bending, an error of first order that is taken out.
    const std::string at = "twist = " + short_number(twist);
    const double coarse = load(16), fine = load(32);
    trial.compare(12.854, 2 * fine - coarse, at);
    trial.converges(1, {error_of(12.854, coarse), error_of(12.854, fine)}, at);
  }
}

}  // namespace

std::span<const Case> bending_cases() {
  static constexpr std::array rows{
      Case{
          "elastica", "Clamped strip: the elastica",
          "A strip whose threads keep their length, clamped at one end, bends under its own weight; its energy is that "
          "of the table of forces, its shape the one of least energy.",
          "$\\theta'' = -\\frac{q}{B}(L - s)\\cos\\theta$; drop 0.12347, 0.70020, 0.93752, 0.98114 L at $qL^3/B$ = 1, "
          "10, "
          "100, 1000",
          "L. Euler's elastica (1744), solved by Runge-Kutta's method", "m", 6e-4, 0.15, elastica},
      Case{"strip_of_springs", "Clamped strip of the report's springs",
           "The same strip in motion until it rests, qL³/B = 1 and 100: its springs do not push, so its threads become "
           "a little shorter than the elastica's.",
           "drop 0.12347 and 0.93752 L", "L. Euler's elastica, as above; report (2.5)", "m", 1e-3, 0, strip_of_springs},
      Case{"end_load", "Clamped strip with a load at its end",
           "A weightless strip carries 4 B/L² at its end: how far the end goes down, and back.",
           "drop 0.66996 L, shortening 0.32894 L", "K. Mattiasson, Int. J. Numer. Methods Eng. 17, 145 (1981)", "m",
           1e-3, 0.3, end_load},
      Case{
          "rest_curvature", "A strip curls to its rest curvature",
          "A clamped strip of 1 m without weight and with $\\kappa_{warp}$ = 3/m moves until it rests: how far its end "
          "is above the clamp.",
          "$(1 - \\cos\\kappa_0 l)/\\kappa_0$, a circle's arc", "A. Garg et al., Cubic Shells, SCA 2007", "m", 5e-3,
          0.15, rest_curvature},
      Case{"isotropy", "Bending in every direction",
           "A cloth with twist = 1 is laid onto a cylinder at 0, 15, 30 and 45° to its threads: its energy per area is "
           "the same.",
           "$\\tfrac12 B/R^2$", "M. Bergou et al., SGP 2006; report 2.1.4", "J/m²", 2e-3, 0, isotropy},
      Case{"lateral_buckling", "A strip on edge buckles sideways",
           "The weight at which a strip that stands on edge, clamped at one end, leaves its plane.",
           "$q L^3 = 12.854\\sqrt{EI\\,C}$, $EI = Bw$, $C = 2\\,\\mathrm{twist}\\,B w$",
           "S. Timoshenko, J. Gere, Theory of Elastic Stability, 2nd ed. (1961), 6.3", "", 0.03, 0.3, lateral_buckling},
  };
  return rows;
}

}  // namespace tyglab::verify
