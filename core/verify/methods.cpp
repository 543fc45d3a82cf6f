// What is known on paper of the methods themselves: frequency, growth and energy on an oscillator, limits of dt.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>

#include "core/analysis/boundary.h"
#include "core/integrators/scheme.h"
#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

using std::numbers::pi;

/// What one step makes of an oscillation: y = r^n cos(n φ + c).
struct StepFactor {
  double phase, growth;
};

/// Of an oscillator with hω = z.
StepFactor step_factor(Trial& trial, std::string_view method, double z) {
  Preset preset = quiet_weight(method);
  preset.dt = z / std::sqrt(preset.k / preset.m);
  Simulation simulation = trial.start(preset);
  trial.advance(simulation, 3);
  double y[4];
  for (double& value : y) {
    value = simulation.position(0, 0).y - preset.x_0.y;
    trial.advance(simulation, 1);
  }
  // y[n+1] = p y[n] - q y[n-1], whose roots are r exp(±iφ).
  const double det = y[1] * y[1] - y[0] * y[2];
  const double p = (y[1] * y[2] - y[0] * y[3]) / det, q = (y[2] * y[2] - y[1] * y[3]) / det;
  const double growth = std::sqrt(q);
  return {std::acos(p / (2 * growth)), growth};
}

constexpr std::array all_z{0.08, 0.4, 1.2};  // hω

/// What TR-BDF2 makes of y' = λ y in a step, z = λ dt.
std::complex<double> tr_bdf2(std::complex<double> z) {
  const double part = 2 - std::sqrt(2.0), rest = (1 - part) / (2 - part);
  const std::complex<double> middle = (1.0 + part / 2 * z) / (1.0 - part / 2 * z);
  return (middle - (1 - part) * (1 - part)) / (part * (2 - part)) / (1.0 - rest * z);
}

void method_frequency(Trial& trial) {
  for (const double z : all_z) {
    for (const char* name : {"verlet", "semi_implicit_euler", "velocity_verlet", "damped_verlet"})
      trial.compare(2 * std::asin(z / 2), step_factor(trial, name, z).phase, name);
    for (const char* name : {"euler", "implicit_euler"})
      trial.compare(std::atan(z), step_factor(trial, name, z).phase, name);
    trial.compare(std::arg(tr_bdf2({0, z})), step_factor(trial, "tr_bdf2", z).phase, "tr_bdf2");
    trial.compare(2 * std::atan(z / 2), step_factor(trial, "implicit_midpoint", z).phase, "implicit_midpoint");
    trial.compare(std::atan2(z - z * z * z / 6, 1 - z * z / 2 + z * z * z * z / 24), step_factor(trial, "rk4", z).phase,
                  "rk4");
  }
}

void method_growth(Trial& trial) {
  for (const double z : all_z) {
    const auto is = [&](const char* name, double growth) {
      trial.compare(growth, step_factor(trial, name, z).growth, name);
    };
    is("euler", std::sqrt(1 + z * z));
    is("improved_euler", std::sqrt(1 + z * z / 2));
    // With one spring these solve implicit Euler's equations to the end.
    for (const char* name : {"implicit_euler", "projective_dynamics", "vbd", "xpbd"})
      is(name, 1 / std::sqrt(1 + z * z));
    is("tr_bdf2", std::abs(tr_bdf2({0, z})));
    is("rk4", std::sqrt(1 - std::pow(z, 6) / 72 + std::pow(z, 8) / 576));
    for (const char* name :
         {"verlet", "semi_implicit_euler", "velocity_verlet", "damped_verlet", "force_gradient4", "implicit_midpoint"})
      is(name, 1);
  }
}

void energy(Trial& trial) {
  for (const char* name :
       {"verlet", "semi_implicit_euler", "velocity_verlet", "damped_verlet", "force_gradient4", "implicit_midpoint"}) {
    Preset preset = taut_sheet(6, 50, 0, name);
    preset.dt = 0.2 * std::sqrt(preset.m / preset.k_s), preset.tolerance = 1e-12;
    State state = start_state(preset);
    double phase = 0;
    for (int i = 1; i < 5; ++i)
      for (int j = 1; j < 5; ++j)
        for (auto* x : {&state.x.x, &state.x.y, &state.x.z})
          (*x)[std::size_t(i * 6 + j)] += 1e-4 * std::sin(phase += 2.4);
    Simulation simulation = trial.start(preset);
    simulation.load(state);
    // Means over pieces of the run, since the energy swings about its mean by a part of order dt².
    const auto mean = [&] {
      double sum = 0;
      constexpr int looks = 2000;
      for (int n = 0; n < looks; ++n) {
        trial.advance(simulation, 5);
        sum += simulation.energy().energy.total();
      }
      return sum / looks;
    };
    const double rest = trial.start(preset).energy().energy.total(), first = mean() - rest;
    trial.advance(simulation, 100'000);
    trial.compare(first, mean() - rest, name);
  }
}

/// Whether y of the mass on a spring stays bounded at hω = z: a growth by 1e-3 a step shows in 20,000 steps.
bool stays_bounded(Trial& trial, const char* name, double z) {
  Preset preset = quiet_weight(name);
  preset.dt = z / std::sqrt(preset.k / preset.m);
  Simulation simulation = trial.start(preset);
  simulation.stop_when({});
  const auto done = simulation.advance(20'000);
  trial.look();
  trial.show(simulation);
  return !done.diverged && std::abs(simulation.position(0, 0).y - preset.x_0.y) < 1e3 * preset.offset;
}

void oscillator_limit(Trial& trial) {
  struct Limit {
    const char* method;
    double z;
  };
  for (const Limit& of : {Limit{"verlet", 2},
                          {"velocity_verlet", 2},
                          {"semi_implicit_euler", 2},
                          {"damped_verlet", 2},
                          {"rk4", std::sqrt(8.0)}})
    trial.compare(of.z,
                  bisect(0.9 * of.z, 1.1 * of.z, 1e6, [&](double at) { return stays_bounded(trial, of.method, at); }),
                  of.method);
}

void chain_limit(Trial& trial) {
  // A taut chain between two pins: the fastest of its N beads' longitudinal modes.
  constexpr int beads = 7;
  for (const char* name : {"verlet", "velocity_verlet"}) {
    Preset preset = quiet_cloth(beads + 2, 1, name);
    preset.pins.mode = Pins::Mode::list, preset.pins.list = {{0, 0}, {beads + 1, 0}};
    preset.initial_stretch = 1.1;
    const double w = 2 * std::sqrt(preset.k_s / preset.m) * std::sin(beads * pi / (2 * (beads + 1)));
    const double exact = 2 / w;
    trial.compare(exact,
                  bisect(0.9 * exact, 1.1 * exact, 1e4,
                         [&](double dt) {
                           trial.look();
                           preset.dt = dt;
                           return !unstable(trial.scene(preset));
                         }),
                  name);
    trial.show(trial.start(preset));
  }
}

}  // namespace

std::span<const Case> method_cases() {
  static constexpr std::array rows{
      Case{"method_frequency", "How fast methods let an oscillator turn",
           "The phase that one step adds to an oscillation, at hω = 0.08, 0.4 and 1.2.",
           "$2\\arcsin\\tfrac{h\\omega}2$ (Verlet), $2\\arctan\\tfrac{h\\omega}2$ (implicit midpoint), "
           "$\\arctan h\\omega$ (Euler, implicit Euler), $\\arg R(ih\\omega)$ (Runge-Kutta 4, TR-BDF2)",
           "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, I", "rad", 1e-6, 0, method_frequency},
      Case{
          "method_growth", "How methods let an oscillator grow or decay",
          "The factor that one step puts on an oscillation, at hω = 0.08, 0.4 and 1.2.",
          "$\\sqrt{1 + z^2}$ (Euler), $\\sqrt{1 + z^2/2}$ (improved Euler), $1/\\sqrt{1 + z^2}$ (implicit Euler), "
          "$\\sqrt{1 - z^6/72 + z^8/576}$ (Runge-Kutta 4), $|R(iz)|$ (TR-BDF2), 1 (symplectic methods), $z = h\\omega$",
          "Eigenvalues of one step; E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.2", "", 1e-8,
          0, method_growth},
      Case{"energy", "Energy of symplectic methods",
           "An undamped taut sheet is shaken and swings for 120,000 steps: its energy, averaged over 10,000 steps at "
           "the "
           "beginning and at the end, stays what it was.",
           "$\\overline{E}(t) = \\overline{E}(0)$",
           "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, IX.8", "J", 3e-4, 0, energy},
      Case{"oscillator_limit", "Largest stable dt on an oscillator",
           "The hω from which on 20,000 steps of the running code no longer stay bounded, found by bisection.",
           "2 (Verlet and its kin), $2\\sqrt2$ (Runge-Kutta 4)",
           "E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, IV.2; report 2.2", "", 2e-4, 0,
           oscillator_limit},
      Case{"chain_limit", "Largest stable dt on a taut chain",
           "The dt from which on a perturbation of a taut chain of 7 beads grows, found by bisection.",
           "$dt = 2/\\omega$, $\\omega = 2\\sqrt{k_s/m}\\,\\sin\\frac{7\\pi}{16}$", "J. L. Lagrange; report 2.2", "s",
           2e-4, 0, chain_limit},
  };
  return rows;
}

}  // namespace tyglab::verify
