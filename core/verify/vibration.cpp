// Frequencies of chains and sheets: exact for the lattice, and in the limit of a fine one.
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

using std::numbers::pi;

/// The frequency ω of a small motion from rest, cos ωt, that is about `w`: from the first coordinate that `read`
/// returns, at three moments a tenth of the period apart.
double frequency(Trial& trial, const Preset& preset, const State& state, double w,
                 const std::function<double(const Simulation&)>& read) {
  Simulation simulation = trial.start(preset);
  simulation.load(state);
  const int apart = std::max(1, int(0.1 * 2 * pi / w / preset.dt));
  double y[3];
  for (double& value : y) {
    trial.advance(simulation, apart);
    value = read(simulation);
  }
  return std::acos((y[0] + y[2]) / (2 * y[1])) / (apart * preset.dt);
}

/// A chain between two pins, stretched, without gravity.
Preset taut_chain(int beads) {
  Preset preset = quiet_cloth(beads + 2, 1, "rk4");
  preset.pins.mode = Pins::Mode::list, preset.pins.list = {{0, 0}, {beads + 1, 0}};
  preset.initial_stretch = 1.2, preset.dt = 5e-5;
  return preset;
}

void taut_chain_modes(Trial& trial) {
  constexpr int beads = 9;
  constexpr double amplitude = 1e-6;
  const Preset preset = taut_chain(beads);
  const double tension = preset.k_s * (1 - 1 / preset.initial_stretch);  // over length
  for (const bool along : {false, true})
    for (const int mode : {1, 2, 5, 9}) {
      const double sine = std::sin(mode * pi / (2 * (beads + 1)));
      const double w = 2 * std::sqrt((along ? preset.k_s : tension) / preset.m) * sine;
      State state = start_state(preset);
      for (int i = 1; i <= beads; ++i)
        (along ? state.x.y : state.x.z)[std::size_t(i)] += amplitude * std::sin(i * mode * pi / (beads + 1));
      const double place = start_state(preset).x.y[1];
      const auto read = [&](const Simulation& s) { return along ? s.position(1, 0).y - place : s.position(1, 0).z; };
      trial.compare(w, frequency(trial, preset, state, w, read),
                    (along ? "along, mode " : "across, mode ") + std::to_string(mode));
    }
}

/// A square lattice under tension in a frame, without gravity: no spring ever switches.
Preset taut_frame() {
  Preset preset = quiet_cloth(9, 12, "rk4");
  preset.initial_stretch = 1.2, preset.pins.mode = Pins::Mode::boundary, preset.dt = 5e-5;
  return preset;
}

/// Displaced out of its plane by amplitude sin(α i) sin(β j).
State in_mode(const Preset& preset, double alpha, double beta, double amplitude) {
  State state = start_state(preset);
  for (int i = 0; i < preset.rows; ++i)
    for (int j = 0; j < preset.columns; ++j)
      state.x.z[std::size_t(i) * std::size_t(preset.columns) + std::size_t(j)] +=
          amplitude * std::sin(alpha * i) * std::sin(beta * j);
  return state;
}

/// What all springs do to a mode, in units of their constant: straight ones, and diagonal ones.
double mode_sum(double alpha, double beta) {
  return 2 - std::cos(alpha) - std::cos(beta) + 2 * (1 - std::cos(alpha) * std::cos(beta));
}

/// What a method makes of the frequency w (method_frequency in methods.cpp).
double own_frequency(const Preset& preset, double w) {
  const double h = preset.dt;
  return preset.integrator == "verlet"              ? 2 / h * std::asin(h * w / 2)
         : preset.integrator == "implicit_midpoint" ? 2 / h * std::atan(h * w / 2)
                                                    : w;
}

void taut_sheet_modes(Trial& trial) {
  struct Mode {
    int p, q;
  };
  for (const char* method : {"rk4", "verlet", "implicit_midpoint"})
    for (const auto& [p, q] : {Mode{1, 1}, {2, 3}, {4, 1}, {7, 10}}) {
      Preset preset = taut_frame();
      preset.integrator = method;
      const double alpha = p * pi / (preset.rows - 1), beta = q * pi / (preset.columns - 1);
      const double kappa = preset.k_s * (1 - 1 / preset.initial_stretch);
      const double w = std::sqrt(2 / preset.m * kappa * mode_sum(alpha, beta));
      trial.compare(own_frequency(preset, w),
                    frequency(trial, preset, in_mode(preset, alpha, beta, 1e-6), w,
                              [](const Simulation& s) { return s.position(1, 1).z; }),
                    std::string(method) + ", mode " + std::to_string(p) + ", " + std::to_string(q));
    }
}

void damped_sheet(Trial& trial) {
  Preset preset = taut_frame();
  preset.k_d = 2e-4;
  const double alpha = pi / (preset.rows - 1), beta = 2 * pi / (preset.columns - 1), amplitude = 1e-6;
  const double sum = 2 / preset.m * mode_sum(alpha, beta), kappa = preset.k_s * (1 - 1 / preset.initial_stretch);
  const double decay = preset.k_d * sum / 2, w = std::sqrt(kappa * sum - decay * decay);
  Simulation simulation = trial.start(preset);
  simulation.load(in_mode(preset, alpha, beta, amplitude));
  trial.advance(simulation, 600);
  const double t = simulation.time();
  const double left = std::exp(-decay * t) * (std::cos(w * t) + decay / w * std::sin(w * t));
  trial.compare(left, simulation.position(4, 3).z / (amplitude * std::sin(4 * alpha) * std::sin(3 * beta)));
}

/// Laguerre's polynomials L_0 … L_n at x.
std::vector<double> laguerre(int n, double x) {
  std::vector<double> L{1, 1 - x};
  for (int k = 1; k < n; ++k) L.push_back(((2 * k + 1 - x) * L[std::size_t(k)] - k * L[std::size_t(k) - 1]) / (k + 1));
  return L;
}

/// The first roots of L_n, rising.
std::vector<double> laguerre_roots(int n, std::size_t count) {
  std::vector<double> roots;
  const auto value = [&](double x) { return laguerre(n, x)[std::size_t(n)]; };
  const double apart = 0.2 / n;
  for (double x = 0; roots.size() < count && x < 4 * n; x += apart) {
    double low = x, high = x + apart;
    if ((value(low) > 0) == (value(high) > 0)) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      ((value(low) > 0) == (value(middle) > 0) ? low : high) = middle;
    }
    roots.push_back(low);
  }
  return roots;
}

/// The frequency of a hanging chain of N beads, hardly extensible, in the shape of the eigenvector that belongs to a
/// root of L_N.
double swing(Trial& trial, const Preset& preset, double root) {
  const int beads = preset.rows - 1;
  const std::vector<double> shape = laguerre(beads, root);  // from the lowest bead up
  State state = start_state(preset);
  for (int i = 1; i <= beads; ++i) {
    const double hangs_below = preset.m * preset.g * (beads + 1 - i);
    state.x.y[std::size_t(i)] = state.x.y[std::size_t(i) - 1] - preset.L - hangs_below / preset.k_s;
    state.x.z[std::size_t(i)] = 1e-6 * preset.L * shape[std::size_t(beads - i)];
  }
  return frequency(trial, preset, state, std::sqrt(root * g / preset.L),
                   [&](const Simulation& s) { return s.position(beads, 0).z; });
}

Preset hanging_chain(int beads, double L) {
  Preset preset = quiet_cloth(beads + 1, 1, "rk4");
  preset.pins.mode = Pins::Mode::top_row;
  preset.g = g, preset.L = L, preset.m = 0.1 * L;
  preset.k_s = 1e6 * preset.m * preset.g * beads / preset.L;  // the uppermost spring gives by 1e-6 of its length
  preset.dt = 1 / std::sqrt(preset.k_s / preset.m);
  return preset;
}

void hanging_beads(Trial& trial) {
  constexpr int beads = 5;
  const Preset preset = hanging_chain(beads, 0.1);
  for (const double root : laguerre_roots(beads, beads))
    trial.compare(std::sqrt(root * g / preset.L), swing(trial, preset, root));
}

void hanging_swings(Trial& trial) {
  constexpr std::array zeros{2.404825557695773, 5.520078110286311, 8.653727912911013};  // of J_0
  for (std::size_t mode = 0; mode < zeros.size(); ++mode)
    trial.refine(
        2, zeros[mode] / 2 * std::sqrt(g), {1 / 12.5, 1 / 24.5, 1 / 48.5},
        [&](double h) {
          // A bead stands for a cell, so the chain of 1 m ends half a cell beyond the last one.
          const int beads = int(1 / h);
          return swing(trial, hanging_chain(beads, h), laguerre_roots(beads, mode + 1)[mode]);
        },
        "swing " + std::to_string(mode + 1));
}

}  // namespace

std::span<const Case> vibration_cases() {
  static constexpr std::array rows{
      Case{"taut_chain_modes", "Modes of a taut chain",
           "A taut chain of 9 beads swings along and across its length in four of its modes each.",
           "$\\omega = 2\\sqrt{k/m}\\,\\sin\\frac{p\\pi}{2(N+1)}$, $k = k_s$ along, $k_s(1 - 1/s)$ across",
           "J. L. Lagrange, Mécanique analytique (1788)", "1/s", 1e-7, 0, taut_chain_modes},
      Case{"taut_sheet_modes", "Modes of a taut sheet",
           "A taut sheet in a frame swings out of its plane in four modes, by three methods; what each of these makes "
           "of "
           "a frequency is taken into account.",
           "$\\omega^2 = \\frac{2\\kappa}m\\left[(2 - \\cos\\alpha - \\cos\\beta) + 2(1 - "
           "\\cos\\alpha\\cos\\beta)\\right]$, "
           "$\\kappa = k_s(1 - 1/s)$",
           "Lattice sum of report (2.5), linearized", "1/s", 1e-7, 0, taut_sheet_modes},
      Case{"damped_sheet", "Damped mode of a taut sheet",
           "Damping slows a mode of the sheet by the same lattice sum; what is left of it after 0.03 s.",
           "$e^{-\\delta t}\\left(\\cos wt + \\frac\\delta w\\sin wt\\right)$, $2\\delta = k_d\\,\\omega^2/\\kappa$",
           "Lattice sum of report (2.6)", "", 1e-8, 0, damped_sheet},
      Case{"hanging_beads", "Swings of a hanging chain of five beads",
           "A hanging chain of 5 beads swings in each of its modes.",
           "$\\omega^2 = \\lambda\\,g/L$, $L_5(\\lambda) = 0$, Laguerre's polynomial",
           "D. Bernoulli (1733); F. R. Gantmacher, M. G. Krein, Oscillation Matrices", "1/s", 1e-5, 0, hanging_beads},
      Case{"hanging_swings", "Swings of a hanging chain",
           "Finer and finer hanging chains of 1 m swing in their first three modes.",
           "$\\omega = \\tfrac12\\,j_{0,n}\\sqrt{g/L}$, $j_{0,n} = 2.4048, 5.5201, 8.6537$",
           "D. Bernoulli (1733); zeros of Bessel's $J_0$", "1/s", 5e-4, 0.15, hanging_swings},
  };
  return rows;
}

}  // namespace tyglab::verify
