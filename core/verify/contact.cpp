// Bodies: bounces, slides, friction.
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "core/integrators/scheme.h"
#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

/// A particle that no spring pulls; another hangs far above, out of the way.
Preset particle(std::string_view method, glm::dvec3 x, glm::dvec3 v) {
  Preset preset = quiet_cloth(2, 1, method);
  preset.k_s = 0, preset.g = g, preset.dt = 1e-3, preset.L = 0.5, preset.tilt_deg = -90;
  preset.x_0 = x, preset.v_0 = v;
  return preset;
}

Body floor(double friction, double restitution) {
  Body body;
  body.shape = Body::Shape::plane, body.friction = friction, body.restitution = restitution;
  return body;
}

Body ball(double r, double friction, double restitution) {
  Body body;
  body.r = r, body.friction = friction, body.restitution = restitution;
  return body;
}

/// Methods of fixed dt whose free fall is exact.
constexpr std::array exact_falls{"verlet",          "velocity_verlet",   "rk4",    "rkn4",
                                 "force_gradient4", "implicit_midpoint", "tr_bdf2"};

/// The height that the particle would reach from where it is.
double reaches(const Simulation& simulation) {
  const ParticleReadout now = simulation.particle(0, 0);
  return now.x.y + now.v.y * now.v.y / (2 * g);
}

constexpr double height = 0.3;

void bounces(Trial& trial) {
  constexpr double e = 0.8;
  const double fall = std::sqrt(2 * height / g);
  for (const char* method : exact_falls) {
    Preset preset = particle(method, {0, height, 0}, {0, 0, 0});
    preset.bodies = {floor(0, e)};
    Simulation simulation = trial.start(preset);
    double contact = fall;
    for (int n = 1; n <= 6; ++n) {
      const double flight = 2 * fall * std::pow(e, n);
      trial.advance(simulation, std::lround((contact + flight / 2) / preset.dt) - simulation.steps());
      contact += flight;
      trial.compare(height * std::pow(e, 2 * n), reaches(simulation),
                    std::string(method) + ", bounce " + std::to_string(n));
    }
  }
}

void end_of_bounces(Trial& trial) {
  for (const double e : {0.3, 0.5, 0.8}) {
    const double exact = std::sqrt(2 * height / g) * (1 + e) / (1 - e);
    Preset preset = particle("verlet", {0, height, 0}, {0, 0, 0});
    preset.dt = 2.5e-4, preset.bodies = {floor(0, e)};
    Simulation simulation = trial.start(preset);
    double moved = 0;
    while (simulation.time() < 2 * exact) {
      trial.advance(simulation, 1);
      const ParticleReadout now = simulation.particle(0, 0);
      if (now.x.y != 0 || std::abs(now.v.y) > 1e-9) moved = simulation.time();
    }
    trial.compare(exact, moved, "e = " + std::to_string(e).substr(0, 3));
  }
}

/// Calls look(simulation, bounce, time at its top) near the top after each of 100 bounces with e = 1.
template <class Look>
void bounce_on(Trial& trial, const Look& look) {
  for (const char* method : exact_falls) {
    Preset preset = particle(method, {0, height, 0}, {0, 0, 0});
    preset.bodies = {floor(0, 1)};
    Simulation simulation = trial.start(preset);
    for (int bounce = 1; bounce <= 100; ++bounce) {
      const double top = bounce * 2 * std::sqrt(2 * height / g);
      trial.advance(simulation, std::lround(top / preset.dt) - simulation.steps());
      look(simulation, top, std::string(method) + ", bounce " + std::to_string(bounce));
    }
  }
}

void elastic_bounces(Trial& trial) {
  bounce_on(trial, [&](const Simulation& simulation, double, const std::string& at) {
    trial.compare(height, reaches(simulation), at);
  });
}

void bounce_times(Trial& trial) {
  bounce_on(trial, [&](const Simulation& simulation, double top, const std::string& at) {
    trial.compare(top, simulation.time() + simulation.particle(0, 0).v.y / g, at);
  });
}

void slide(Trial& trial) {
  constexpr double speed = 1.3, friction = 0.4;
  for (const char* method : exact_falls) {
    Preset preset = particle(method, {0, 0, 0}, {speed * 0.6, 0, speed * 0.8});
    preset.bodies = {floor(friction, 0.5)};
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, std::lround(1.2 * speed / (friction * g) / preset.dt));
    trial.compare(speed * speed / (2 * friction * g), glm::length(simulation.position(0, 0)), method);
  }
}

void slope(Trial& trial) {
  // On a sphere at 20° from its top: the friction below which it slides.
  constexpr double r = 0.3, angle = 20 * 3.14159265358979323846 / 180;
  const glm::dvec3 start = r * glm::dvec3(std::sin(angle), std::cos(angle), 0);
  for (const char* method : {"verlet", "rk4", "implicit_midpoint"})
    trial.compare(std::tan(angle),
                  bisect(0.3, 0.45, 1e4,
                         [&](double friction) {
                           Preset preset = particle(method, start, {0, 0, 0});
                           preset.bodies = {ball(r, friction, 0)};
                           Simulation simulation = trial.start(preset);
                           trial.advance(simulation, 4000);
                           return glm::distance(simulation.position(0, 0), start) > 1e-6;
                         }),
                  method);
}

void smooth_sphere(Trial& trial) {
  constexpr double r = 0.3, from = 0.2;  // rad
  const double exact = 2.0 / 3 * std::cos(from);
  for (const char* method : {"verlet", "rk4", "implicit_midpoint"})
    trial.refine(
        1, exact, {1e-3, 5e-4, 2.5e-4, 1.25e-4},
        [&](double dt) {
          Preset preset = particle(method, r * glm::dvec3(std::sin(from), std::cos(from), 0), {0, 0, 0});
          preset.dt = dt, preset.bodies = {ball(r, 0, 0)};
          Simulation simulation = trial.start(preset);
          double cosine = 1;
          do {
            cosine = simulation.position(0, 0).y / r;
            trial.advance(simulation, 1);
          } while (glm::length(simulation.position(0, 0)) - r < 1e-12);
          return cosine;
        },
        method);
}

void fast_particle(Trial& trial) {
  // Within one step of 10 ms it meets the top of a sphere 2.8 m below, bounces, and flies up for the rest of the step.
  constexpr double r = 0.2, from = 3, speed = 1000, dt = 0.01;
  const double impact = (std::sqrt(speed * speed + 2 * g * (from - r)) - speed) / g, left = dt - impact;
  const double exact = r + (speed + g * impact) * left - g * left * left / 2;
  for (const char* method : exact_falls) {
    Preset preset = particle(method, {0, from, 0}, {0, -speed, 0});
    preset.dt = dt, preset.bodies = {ball(r, 0, 1)};
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, 1);
    trial.compare(exact, simulation.position(0, 0).y, method);
  }
}

}  // namespace

std::span<const Case> contact_cases() {
  static constexpr std::array rows{
      Case{"bounces", "Heights of bounces", "A ball falls 0.3 m onto a floor with e = 0.8: the heights of 6 bounces.",
           "$h_n = e^{2n} h$", "I. Newton's law of restitution; report 2.1.5", "m", 1e-10, 0, bounces},
      Case{"end_of_bounces", "Bounces come to an end",
           "Infinitely many bounces take a finite time; then the ball lies on the floor and does not move.",
           "$t = \\sqrt{\\frac{2h}g}\\,\\frac{1+e}{1-e}$", "Geometric series of flights", "s", 2e-3, 0, end_of_bounces},
      Case{"elastic_bounces", "A hundred bounces without loss",
           "A ball with e = 1 returns to its height 100 times, with steps of 1 ms that know nothing of the impacts.",
           "$h_n = h$", "Conservation of energy", "m", 1e-9, 0, elastic_bounces},
      Case{"bounce_times", "When a hundred bounces come", "The same ball: the times at which it is at its top.",
           "$t_n = 2n\\sqrt{2h/g}$", "Free fall", "s", 1e-9, 0, bounce_times},
      Case{"slide", "Friction stops a slide", "A particle is thrown along a rough floor and stops.",
           "$s = \\frac{v^2}{2\\mu g}$", "C. A. de Coulomb (1785); report 2.1.5", "m", 1e-7, 0, slide},
      Case{"slope", "Angle of friction",
           "A particle is set down on the side of a sphere at 20°: the friction from which it stays, by bisection.",
           "$\\mu = \\tan\\theta$", "C. A. de Coulomb (1785)", "", 1e-4, 0, slope},
      Case{"smooth_sphere", "A particle leaves a smooth sphere",
           "A particle slides down a smooth sphere from 0.2 rad beside its top, and flies off.",
           "$\\cos\\theta = \\tfrac23\\cos\\theta_0$", "Energy and centripetal force; a classic of mechanics", "", 2e-3,
           0.3, smooth_sphere},
      Case{"fast_particle", "Nothing is tunneled through",
           "A particle falls at 1000 m/s through several diameters of a sphere in one step, and bounces off its top.",
           "$y = r + v'(dt - \\tau) - \\tfrac12 g (dt - \\tau)^2$, $\\tau$ the time of impact", "Newton; report 2.1.5",
           "m", 1e-9, 0, fast_particle},
  };
  return rows;
}

}  // namespace tyglab::verify
