// Bodies: bounces, slides, friction.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/verify/trial.h"

namespace tyglab::verify {
namespace {

using std::numbers::pi;

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

/// Methods of second order and above, whose free fall is exact: those of fixed dt, and one that chooses its steps.
constexpr std::array exact_methods{"verlet",          "velocity_verlet",   "rk4",     "rkn4",
                                   "force_gradient4", "implicit_midpoint", "tr_bdf2", "dopri5"};
constexpr std::span exact_falls = std::span(exact_methods).first<exact_methods.size() - 1>();

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
  constexpr double r = 0.3, angle = pi / 9;
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

void inclined_plane(Trial& trial) {
  constexpr double angle = pi / 6, t = 0.5;
  const glm::dvec3 start(0, 0.2, 0), down(std::cos(angle), -std::sin(angle), 0);
  for (const char* method : exact_methods)
    for (const double friction : {0.0, 0.3, 0.7}) {
      Preset preset = particle(method, start, {0, 0, 0});
      Body plane = floor(friction, 0);
      plane.y = start.y, plane.turn.z = -30;
      preset.bodies = {plane};
      Simulation simulation = trial.start(preset);
      trial.advance(simulation, std::lround(t / preset.dt));
      const double exact = std::max(0.0, std::sin(angle) - friction * std::cos(angle)) * g * t * t / 2;
      const glm::dvec3 way = simulation.position(0, 0) - start;
      const std::string at = std::string(method) + ", friction " + std::to_string(friction).substr(0, 3);
      trial.compare(exact, glm::dot(way, down), at);
      // And nowhere else.
      trial.compare(0, glm::length(way - glm::dot(way, down) * down), at);
    }
}

void belt(Trial& trial) {
  constexpr double friction = 0.4, speed = 1.5;
  for (const char* method : exact_methods) {
    Preset preset = particle(method, {0, 0, 0}, {0, 0, 0});
    Body belt = floor(friction, 0);
    belt.velocity.x = speed;
    preset.bodies = {belt};
    Simulation simulation = trial.start(preset);
    for (int n = 0; n < 8; ++n) {
      trial.advance(simulation, 100);
      trial.compare(std::min(speed, friction * g * simulation.time()), simulation.particle(0, 0).v.x, method);
    }
  }
}

void lift(Trial& trial) {
  // It moves for 0.3 s, and stops at once.
  constexpr double speed = 0.7, stops = 0.3;
  for (const char* method : exact_methods) {
    Preset preset = particle(method, {0, 0, 0}, {0, 0, 0});
    Body lift;
    lift.shape = Body::Shape::box, lift.size = {0.4, 0.2, 0.4};
    lift.path = {{0, {0, -0.1, 0}}, {stops, {0, speed * stops - 0.1, 0}}};
    preset.bodies = {lift};
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, 200);
    trial.compare(speed * simulation.time(), simulation.position(0, 0).y, std::string(method) + ", on the lift");
    trial.advance(simulation, 150);
    trial.compare(speed * stops + speed * speed / (2 * g), reaches(simulation), std::string(method) + ", in flight");
    trial.advance(simulation, 150);
    trial.compare(speed * stops, simulation.position(0, 0).y, std::string(method) + ", back on it");
  }
}

/// A particle on a turntable, with the table's speed.
constexpr double from_axis = 0.5, turns_at = 3;  // m, rad/s
Preset on_turntable(std::string_view method, double friction, double dt) {
  Preset preset = particle(method, {from_axis, 0, 0}, {0, 0, -turns_at * from_axis});
  Body table = floor(friction, 0);
  table.spin.y = turns_at;
  preset.dt = dt, preset.bodies = {table};
  return preset;
}

void turntable_limit(Trial& trial) {
  for (const char* method : {"verlet", "rk4", "implicit_midpoint"})
    trial.compare(turns_at * turns_at * from_axis / g,
                  bisect(0.4, 0.5, 1e4,
                         [&](double friction) {
                           Simulation simulation = trial.start(on_turntable(method, friction, 1e-3));
                           trial.advance(simulation, 3000);
                           return glm::length(simulation.position(0, 0)) > from_axis + 1e-3;
                         }),
                  method);
}

void turntable(Trial& trial) {
  for (const char* method : exact_falls) {
    std::vector<double> off;
    for (const double dt : {4e-3, 2e-3, 1e-3}) {
      Simulation simulation = trial.start(on_turntable(method, 0.6, dt));
      trial.advance(simulation, std::lround(1 / dt));
      const double angle = turns_at * simulation.time();
      const glm::dvec3 exact = from_axis * glm::dvec3(std::cos(angle), 0, -std::sin(angle));
      off.push_back(glm::distance(simulation.position(0, 0), exact));
    }
    trial.compare(from_axis, from_axis + off.back(), method);
    trial.converges(2, off, method);
  }
}

void thrown_by_ball(Trial& trial) {
  // At 90 m/s the ball passes through the particle's place within one step.
  constexpr double e = 0.5, distance = 1, r = 0.02;
  for (const Scheme& method : schemes())
    for (const double speed : {3.0, 90.0}) {
      Preset preset = particle(method.name, {0, 0, 0}, {0, 0, 0});
      preset.g = 0;
      Body thrower = ball(r, 0.3, e);
      thrower.c.x = -distance, thrower.velocity.x = speed;
      preset.bodies = {thrower};
      Simulation simulation = trial.start(preset);
      const double meets = (distance - r) / speed;
      trial.advance(simulation, std::lround(std::ceil(2 * meets / preset.dt)));
      const std::string at = std::string(method.name) + ", " + std::to_string(int(speed)) + " m/s";
      trial.compare((1 + e) * speed, simulation.particle(0, 0).v.x, at);
      if (method.order_undamped >= 2)
        trial.compare((1 + e) * speed, simulation.position(0, 0).x / (simulation.time() - meets), at + ", on average");
    }
}

void box_edge(Trial& trial) {
  // It meets the edge in the middle of a step. Until the end of that step it is held.
  constexpr double speed = 1, to_edge = 0.2, top = 0.25, falls = 0.2;
  for (const char* method : exact_falls) {
    std::vector<double> errors;
    double fallen = 0, exact = 0;
    for (const int steps : {100, 200, 400}) {
      Preset preset = particle(method, {0, top, 0}, {speed, 0, 0});
      preset.dt = to_edge / speed / (steps + 0.5);
      Body box;
      box.shape = Body::Shape::box, box.size = {2 * to_edge, 2 * top, 0.4};
      preset.bodies = {box};
      Simulation simulation = trial.start(preset);
      trial.advance(simulation, steps);
      trial.compare(top, simulation.position(0, 0).y, std::string(method) + ", before the edge");
      trial.advance(simulation, std::lround(falls / preset.dt));
      exact = g * std::pow(simulation.time() - to_edge / speed, 2) / 2, fallen = top - simulation.position(0, 0).y;
      errors.push_back(error_of(exact, fallen));
    }
    trial.compare(exact, fallen, method);
    trial.converges(1, errors, method);
  }
}

/// A thread held at both ends, without weight, over a drum that lifts it and turns below it.
void capstan(Trial& trial) {
  constexpr int particles = 61;
  for (const double friction : {0.1, 0.2, 0.3}) {
    Preset preset = quiet_cloth(particles, 1, "verlet");
    preset.L = 1.0 / (particles - 1), preset.m = 2e-4, preset.k_s = 200, preset.k_d = 0.2, preset.dt = 1e-4;
    preset.tilt_deg = 0, preset.x_0 = {0, 0, -0.5};  // along z
    preset.pins.mode = Pins::Mode::list;
    preset.pins.list = {{0, 0}, {particles - 1, 0}};
    Body drum;
    drum.shape = Body::Shape::cylinder, drum.friction = friction;
    drum.r = 0.2, drum.length = 0.2, drum.turn.z = 90, drum.spin.x = 5;
    drum.path = {{0, {0, -0.25, 0}}, {0.5, {0, 0.1, 0}}};
    preset.bodies = {drum};
    Simulation simulation = trial.start(preset);
    trial.advance(simulation, std::lround(6 / preset.dt));
    const auto spring = [&](int i) { return simulation.position(i + 1, 0) - simulation.position(i, 0); };
    const glm::dvec3 first = spring(1), last = spring(particles - 3);
    // By so much the thread turns between its ends.
    const double angle = std::acos(glm::dot(glm::normalize(first), glm::normalize(last)));
    const double one = glm::length(first) - preset.L, other = glm::length(last) - preset.L;
    trial.compare(std::exp(friction * angle), std::max(one, other) / std::min(one, other),
                  "friction " + std::to_string(friction).substr(0, 3));
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
      Case{
          "inclined_plane", "Slide down a tilted plane",
          "A particle is set down on a plane tilted by 30°, without friction, with little, and with enough to hold it.",
          "$s = \\tfrac12 g\\,(\\sin\\theta - \\mu\\cos\\theta)\\,t^2$, 0 where $\\mu \\ge \\tan\\theta$",
          "C. A. de Coulomb (1785)", "m", 1e-9, 0, inclined_plane},
      Case{"belt", "A conveyor belt",
           "A particle is set down on a belt that moves: friction drags it along until it is as fast as the belt.",
           "$v = \\min(\\mu g t, V)$", "C. A. de Coulomb (1785)", "m/s", 1e-9, 0, belt},
      Case{"lift", "A lift that stops at once",
           "A box lifts a particle and stops: the particle flies on, and falls back onto the box.",
           "$y = V t$ on the lift, $h = \\frac{V^2}{2g}$ above it in flight", "Free fall, seen from the lift", "m",
           1e-9, 0, lift},
      Case{"turntable_limit", "What a turntable holds",
           "A particle moves with a turntable, 0.5 m from its axis: the friction from which it stays, by bisection.",
           "$\\mu g = \\omega^2 r$", "C. Huygens, De vi centrifuga (1703); Coulomb", "", 1e-4, 0, turntable_limit},
      Case{"turntable", "A turn on a turntable",
           "With enough friction the particle goes around with the table: its distance from its place on it after 1 s, "
           "added to its distance from the axis.",
           "$x = r\\,(\\cos\\omega t, 0, -\\sin\\omega t)$", "Uniform rotation", "m", 1e-4, 0.3, turntable},
      Case{
          "thrown_by_ball", "A ball throws a particle ahead",
          "A ball flies into a particle at rest, slowly and so fast that it passes its place within a step, with every "
          "method.",
          "$v = (1 + e)\\,V$", "I. Newton's law of restitution, seen from the ball", "m/s", 1e-9, 0, thrown_by_ball},
      Case{"box_edge", "Over the edge of a box",
           "A particle slides on a box, over its edge, and falls. In the step in which it passes the edge it is held "
           "until the end of the step, so the fall is of first order.",
           "$s = \\tfrac12 g\\,(t - d/v)^2$", "Free fall", "m", 5e-3, 0.3, box_edge},
      Case{"capstan", "A thread over a drum that turns",
           "A thread without weight, held at both ends, lies over a drum that turns below it: friction pulls one side "
           "taut.",
           "$\\frac{T_2}{T_1} = e^{\\mu\\theta}$", "L. Euler (1762); J. A. Eytelwein (1808)", "", 0.01, 0, capstan},
  };
  return rows;
}

}  // namespace tyglab::verify
