// Motions of single particles and of whole cloths that are known on paper.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "core/analysis/one_weight.h"
#include "core/integrators/scheme.h"
#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

using std::numbers::pi;

/// Whether its position is of first order even in a free fall; improved Euler's velocity alone is.
bool falls_inexactly(const Scheme& method) {
  return method.order_undamped == 1 && method.name != "improved_euler";
}

/// A free cloth that flies without turning: no spring ever pulls.
Preset flying(const Scheme& method) {
  Preset preset = quiet_cloth(3, 4, method.name);
  preset.g = g, preset.dt = 1e-3, preset.v_0 = {0.5, 2, -1};
  return preset;
}

/// How far that cloth has fallen below its straight path, m.
double fallen(const Preset& preset, const Simulation& simulation) {
  return preset.x_0.y + preset.v_0.y * simulation.time() - simulation.position(0, 1).y;
}

void free_fall(Trial& trial) {
  for (const Scheme& method : schemes()) {
    if (falls_inexactly(method)) continue;
    std::vector<double> dampings{0, 0.01};
    if (is_implicit(method) || solves_damping(method)) dampings.push_back(10);
    for (const double k_d : dampings) {
      Preset preset = flying(method);
      preset.k_d = k_d;
      Simulation simulation = trial.start(preset);
      trial.advance(simulation, 1000);
      const double t = simulation.time();
      trial.compare(g * t * t / 2, fallen(preset, simulation), preset.integrator);
    }
  }
}

void free_fall_first_order(Trial& trial) {
  for (const Scheme& method : schemes())
    if (falls_inexactly(method))
      trial.refine(
          1, g / 2, {4e-3, 2e-3, 1e-3},
          [&](double dt) {
            Preset preset = flying(method);
            preset.dt = dt, preset.k_d = 0.01;
            Simulation simulation = trial.start(preset);
            trial.advance(simulation, std::lround(1 / dt));
            return fallen(preset, simulation);
          },
          std::string(method.name));
}

void terminal_velocity(Trial& trial) {
  constexpr double t = 0.4;
  for (const Scheme& method : schemes()) {
    Preset preset = quiet_weight(method.name);
    preset.k = 0, preset.k_d = 0.5, preset.g = g;
    const double exact = preset.m * g / preset.k_d * -std::expm1(-preset.k_d / preset.m * t);
    const auto speed = [&](double dt) {
      preset.dt = dt;
      Simulation simulation = trial.start(preset);
      trial.advance(simulation, std::lround(t / dt));
      return -simulation.particle(0, 0).v.y;
    };
    if (chooses_steps(method))
      trial.compare(exact, speed(1e-3), preset.integrator);
    else
      trial.converges(method.order_damped, {error_of(exact, speed(1e-2)), error_of(exact, speed(5e-3))},
                      preset.integrator),
          trial.compare(exact, speed(2e-4), preset.integrator);
  }
}

/// 1.1 turns of the mass on its spring, where neither place nor speed is 0.
double end_of(const Preset& preset) {
  return 2.2 * pi / std::sqrt(preset.k / preset.m);
}

/// The height above the place of rest after that time in n steps, m.
double swung(Trial& trial, Preset preset, int n) {
  preset.dt = end_of(preset) / n;
  Simulation simulation = trial.start(preset);
  trial.advance(simulation, n);
  return simulation.position(0, 0).y - preset.x_0.y;
}

void swing(Trial& trial, const Preset& preset, int order, int steps) {
  const double exact = exact_weight(preset, end_of(preset)).y - preset.x_0.y;
  if (!chooses_steps(scheme(preset.integrator))) {
    const int coarse = order == 1 ? 4000 : 100;
    trial.converges(order,
                    {error_of(exact, swung(trial, preset, coarse)), error_of(exact, swung(trial, preset, 2 * coarse))},
                    preset.integrator);
  }
  trial.compare(exact, swung(trial, preset, steps), preset.integrator);
}

void oscillation(Trial& trial) {
  for (const Scheme& method : schemes())
    if (method.order_undamped > 1) swing(trial, quiet_weight(method.name), method.order_undamped, 1000);
}

void oscillation_first_order(Trial& trial) {
  for (const Scheme& method : schemes())
    if (method.order_undamped == 1) swing(trial, quiet_weight(method.name), 1, 50'000);
}

void damped_oscillation(Trial& trial) {
  for (const Scheme& method : schemes()) {
    Preset preset = quiet_weight(method.name);
    preset.k_d = 0.4;
    swing(trial, preset, method.order_damped, method.order_damped == 1 ? 50'000 : 1000);
  }
}

/// A mass hangs from a pin that moves up from t = 0 on; how far it has risen after 1.1 turns in n steps, m.
constexpr double towed_at = 0.3;  // m/s: slowly enough that the spring stays taut
double towed(Trial& trial, Preset preset, int n) {
  const double turns = 2.2 * pi / std::sqrt(preset.k_s / preset.m);
  preset.dt = turns / n;
  Simulation simulation = trial.start(preset);
  const double begin = simulation.position(1, 0).y;
  trial.advance(simulation, n);
  return simulation.position(1, 0).y - begin;
}

void tow(Trial& trial) {
  for (const Scheme& method : schemes()) {
    if (method.order_undamped == 1) continue;
    Preset preset = quiet_cloth(2, 1, method.name);
    preset.m = 0.1, preset.k_s = 40, preset.g = g, preset.L = 0.1;
    preset.initial_stretch = 1 + preset.m * g / (preset.k_s * preset.L);
    preset.pins.mode = Pins::Mode::top_row;
    preset.pins.motions = {{.path = {{0, {0, 0, 0}}, {10, {0, 10 * towed_at, 0}}}}};
    const double w = std::sqrt(preset.k_s / preset.m), t = 2.2 * pi / w;
    const double exact = towed_at * (t - std::sin(w * t) / w);
    if (!chooses_steps(method))
      trial.converges(method.order_undamped,
                      {error_of(exact, towed(trial, preset, 100)), error_of(exact, towed(trial, preset, 200))},
                      preset.integrator);
    trial.compare(exact, towed(trial, preset, 1000), preset.integrator);
  }
}

/// Length of a spring at whose end a weight bounces, dropped at rest where the spring is slack: free fall, half a swing
/// on the taut spring, and back up.
double bouncing_length(const Preset& p, double slack, double t) {
  const double fall = std::sqrt(2 * slack / g), v = g * fall, w = std::sqrt(p.k_s / p.m);
  const double taut = 2 * (pi - std::atan(v * w / g)) / w;
  double at = std::fmod(t, 2 * fall + taut);
  if (at > fall + taut) at = 2 * fall + taut - at;  // as it fell, backwards
  if (at <= fall) return p.L - slack + g * at * at / 2;
  const double since = at - fall;
  return p.L + g / (w * w) * (1 - std::cos(w * since)) + v / w * std::sin(w * since);
}

void slack_spring(Trial& trial) {
  for (const char* method : {"rk4", "verlet", "velocity_verlet", "implicit_midpoint"}) {
    Preset preset = quiet_cloth(2, 1, method);
    preset.g = g, preset.L = 0.3, preset.m = 0.01, preset.k_s = 40, preset.dt = 1e-4;
    preset.pins.mode = Pins::Mode::top_row;
    constexpr double slack = 0.1;
    State state = start_state(preset);
    state.x.y[1] = state.x.y[0] - preset.L + slack;
    Simulation simulation = trial.start(preset);
    simulation.load(state);
    for (int n = 0; n < 100; ++n) {
      trial.advance(simulation, 100);
      trial.compare(bouncing_length(preset, slack, simulation.time()), preset.x_0.y - simulation.position(1, 0).y,
                    method);
    }
  }
}

void pendulum(Trial& trial) {
  // From 90°, on a spring that gives by 1e-7 of its length.
  Preset preset = quiet_cloth(2, 1, "velocity_verlet");
  preset.g = g, preset.L = 1, preset.m = 0.1, preset.k_s = 3 * preset.m * g / preset.L * 1e7;
  preset.pins.mode = Pins::Mode::top_row, preset.tilt_deg = 0;
  // T = 2π √(L/g) / agm(1, cos θ/2).
  double a = 1, b = std::cos(pi / 4);
  for (int n = 0; n < 6; ++n) {
    const double mean = (a + b) / 2;
    b = std::sqrt(a * b), a = mean;
  }
  const double exact = 2 * pi * std::sqrt(preset.L / g) / a;
  preset.dt = 0.5 / std::sqrt(preset.k_s / preset.m);
  Simulation simulation = trial.start(preset);
  // A quarter of the period ends where it passes below its pin.
  trial.advance(simulation, std::int64_t(0.2 * exact / preset.dt));
  double before = simulation.position(1, 0).z;
  for (double now = before; now > 0;) {
    before = now;
    trial.advance(simulation, 1);
    now = simulation.position(1, 0).z;
    if (now <= 0) trial.compare(exact, 4 * (simulation.time() - preset.dt * now / (now - before)));
  }
}

/// A free cloth thrown while it is folded, stretched and turned; every particle differs.
State crumpled(const Preset& preset) {
  State state = start_state(preset);
  double phase = 0;
  for (std::size_t p = 0; p < state.x.x.size(); ++p)
    for (auto* field : {&state.x, &state.v})
      for (auto* part : {&field->x, &field->y, &field->z})
        (*part)[p] += (field == &state.x ? 0.3 * preset.L : 0.4) * std::sin(phase += 2.4);
  return state;
}

glm::dvec3 momentum(Simulation& simulation, double m) {
  const State& s = simulation.read();
  glm::dvec3 sum(0);
  for (std::size_t p = 0; p < s.v.x.size(); ++p) sum += m * glm::dvec3(s.v.x[p], s.v.y[p], s.v.z[p]);
  return sum;
}

glm::dvec3 angular_momentum(Simulation& simulation, double m) {
  const State& s = simulation.read();
  glm::dvec3 sum(0);
  for (std::size_t p = 0; p < s.v.x.size(); ++p)
    sum += m * glm::cross(glm::dvec3(s.x.x[p], s.x.y[p], s.x.z[p]), glm::dvec3(s.v.x[p], s.v.y[p], s.v.z[p]));
  return sum;
}

void free_momentum(Trial& trial) {
  for (const Scheme& method : schemes()) {
    Preset preset = bending_cloth(6, 7, method.name);
    preset.g = g, preset.k_d = 0.002, preset.dt = 1e-4;
    Simulation simulation = trial.start(preset);
    simulation.load(crumpled(preset));
    const glm::dvec3 before = momentum(simulation, preset.m);
    trial.advance(simulation, 1000);
    const glm::dvec3 gained = momentum(simulation, preset.m) - before;
    // What it gains to the sides, none, counts beside what it gains downward.
    const double exact = -42 * preset.m * g * simulation.time();
    for (const double sum : {gained.y, exact + gained.x, exact + gained.z})
      trial.compare(exact, sum, preset.integrator);
  }
}

void free_angular_momentum(Trial& trial) {
  for (const char* method : {"velocity_verlet", "verlet", "implicit_midpoint"}) {
    Preset preset = bending_cloth(6, 7, method);
    preset.dt = 1e-4;
    Simulation simulation = trial.start(preset);
    simulation.load(crumpled(preset));
    const glm::dvec3 before = angular_momentum(simulation, preset.m);
    trial.advance(simulation, 2000);
    const glm::dvec3 gained = angular_momentum(simulation, preset.m) - before;
    trial.compare(glm::length(before), glm::length(before) + glm::length(gained), method);
  }
}

/// Two hanging columns of a chain side by side, the left one held at the top, joined below: its right half falls.
void folded_chain(Trial& trial) {
  constexpr double length = 1;
  const double exact = 0.847213084793979 * std::sqrt(2 * length / g);
  const auto time = [&](double h) {
    const int links = int(std::lround(length / h));
    Preset preset = quiet_cloth(links + 1, 1, "velocity_verlet");
    preset.g = g, preset.L = h, preset.m = 0.1 * h;
    preset.k_s = 1e4 / h;
    preset.pins.mode = Pins::Mode::top_row;
    preset.dt = 0.3 / std::sqrt(preset.k_s / preset.m);
    State state = start_state(preset);
    const int down = links / 2;
    for (int i = 0; i <= links; ++i) {
      state.x.z[std::size_t(i)] = i <= down ? 0 : h;
      state.x.y[std::size_t(i)] = -h * (i <= down ? i : 2 * down + 1 - i);
    }
    Simulation simulation = trial.start(preset);
    simulation.load(state);
    // Until its end turns, below.
    while (simulation.time() < 2 * exact && (simulation.time() < exact / 4 || simulation.particle(links, 0).v.y < 0))
      trial.advance(simulation, 1);
    return simulation.time();
  };
  trial.refine(1, exact, {1.0 / 81, 1.0 / 161, 1.0 / 321}, time);
}

}  // namespace

std::span<const Case> motion_cases() {
  static constexpr std::array rows{
      Case{"free_fall", "Free fall, damped and not",
           "A free cloth is thrown and falls for 1 s: damping acts between particles alone, so k_d does not slow it.",
           "$y = y_0 + v_0 t - \\tfrac12 g t^2$ for any $k_d$", "Newton; report (2.1), (2.6)", "m", 1e-11, 0,
           free_fall},
      Case{"free_fall_first_order", "Free fall by methods of first order",
           "The same fall by the methods whose positions are of first order: their error halves with dt.",
           "$y = y_0 + v_0 t - \\tfrac12 g t^2$; these methods fall $\\tfrac12 g t^2 (1 \\pm dt/t)$",
           "Newton; report (2.10)", "m", 1.01e-3, 0.02, free_fall_first_order},
      Case{"terminal_velocity", "Fall against damping",
           "A mass without a spring falls against its damping and nears a final speed.",
           "$v = \\frac{m g}{k_d}\\left(1 - e^{-k_d t/m}\\right)$", "Report (2.3) with k = 0", "m/s", 1e-3, 0.15,
           terminal_velocity},
      Case{"oscillation", "Undamped mass on a spring",
           "A mass swings on its spring for 1.1 turns, by every method of second order and above.",
           "$y = A \\cos\\sqrt{k/m}\\,t$", "Report (2.3), figure 3.2", "m", 1e-4, 0.15, oscillation},
      Case{"tow", "A mass that is lifted by its spring",
           "A mass hangs at rest from a pin that moves up at a constant velocity from $t = 0$ on: it follows, and "
           "swings.",
           "$y = V t - \\frac{V}{w}\\sin wt$, $w = \\sqrt{k_s/m}$", "Report (2.3), seen from the pin", "m", 1e-4, 0.15,
           tow},
      Case{"oscillation_first_order", "Undamped mass on a spring by methods of first order",
           "The same swing by the methods of first order, with 50,000 steps.", "$y = A \\cos\\sqrt{k/m}\\,t$",
           "Report (2.3), figure 3.2", "m", 1e-3, 0.1, oscillation_first_order},
      Case{"damped_oscillation", "Damped mass on a spring", "The same swing with damping, by every method.",
           "$y = A e^{-\\delta t}\\left(\\cos wt + \\frac{\\delta}{w}\\sin wt\\right)$, $\\delta = k_d/2m$, $w^2 = k/m "
           "- "
           "\\delta^2$",
           "Report (2.3)", "m", 1e-3, 0.15, damped_oscillation},
      Case{"slack_spring", "A weight bounces between slack and taut",
           "A weight falls freely until its spring is taut, swings half a turn on it and flies up again, for 1 s.",
           "parabola of free fall, then $L + \\frac{g}{w^2}(1 - \\cos wt) + \\frac{v}{w}\\sin wt$, and back",
           "Pieces of free fall and oscillation, report (2.5)", "m", 5e-5, 0, slack_spring},
      Case{"pendulum", "Pendulum from 90°", "A particle on a nearly rigid spring swings from the horizontal.",
           "$T = 2\\pi\\sqrt{L/g}\\,/\\,\\mathrm{agm}(1, \\cos\\tfrac{\\theta}{2})$",
           "C. F. Gauss; L. D. Landau, E. M. Lifshitz, Mechanics, 11", "s", 3e-7, 0, pendulum},
      Case{"momentum", "Momentum of a free cloth",
           "A crumpled free cloth with stretching, bending and damping: inner forces come in pairs, so gravity alone "
           "changes its momentum, with every method.",
           "$\\Delta p = -M g t$", "Newton's third law", "N s", 1e-9, 0, free_momentum},
      Case{
          "angular_momentum", "Angular momentum of a free cloth",
          "Without damping the forces are central, so a crumpled cloth that turns in space keeps its angular momentum.",
          "$\\sum m\\,x \\times v = \\mathrm{const}$",
          "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical "
          "Integration, IV.1",
          "N m s", 1e-7, 0, free_angular_momentum},
      Case{"folded_chain", "Fall of a folded chain",
           "A chain hangs from both ends side by side and one end is released: it falls faster than a free body, since "
           "the motion of the whole is passed on to an ever shorter part.",
           "$t = \\int_0^1\\sqrt{\\frac{1-u}{2u - u^2}}\\,du\\,\\sqrt{L/g} = 0.84721\\sqrt{2L/g}$",
           "M. G. Calkin, R. H. March, Am. J. Phys. 57, 154 (1989)", "s", 0.01, 0.5, folded_chain},
  };
  return rows;
}

}  // namespace tyglab::verify
