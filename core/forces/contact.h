// Collision of one particle with fixed bodies (2.1.5; docs/model.md, "Collision"). It uses double for both precisions:
// few particles touch a body, and rounding to float would be visible as jitter.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "core/model/preset.h"

namespace tyglab {

/// A particle over one step: position before, tentative position and velocity after.
struct ContactStep {
  glm::dvec3 old_x, x, v;
};

/// How deep `x` is inside the body, m; negative outside.
double depth(const Body& body, const glm::dvec3& x);

/// 8 units in the last place of the largest of |x|, |c|, r: a bound on rounding errors, m. `epsilon` is that of the
/// state's precision.
double contact_tolerance(const Body& body, const glm::dvec3& x, double epsilon);

/// The speed toward the body, m/s, below which a particle rests on it rather than bounces. The step that finds a
/// contact errs in the speed of the bounce, by g dt (Verlet) to 3 g dt (Euler), so with a restitution e, bounces of up
/// to 3 g dt/(1 - e) regain the energy that they lose and would never end. 0 above e = 0.9, where it would end real
/// bounces.
double rest_speed(const Body& body, double g, double dt);

/// Whether a body keeps the particle from where its velocity and acceleration alone would take it within dt. Then the
/// body exerts a force that no formula gives, since collide() corrects positions and velocities.
bool held_by_contact(std::span<const Body> bodies, double dt, double epsilon, const glm::dvec3& x, const glm::dvec3& v,
                     const glm::dvec3& a);

/// Parameters of contacts besides the bodies.
struct ContactRule {
  double dt;       ///< s
  double g;        ///< m/s²
  double epsilon;  ///< of the state's precision
};

/// Corrects x and v for all bodies, in list order and repeatedly. Returns whether x is outside all of them afterwards
/// (overlapping bodies can leave it inside one).
bool collide(std::span<const Body> bodies, const ContactRule& rule, ContactStep& step);

// Gusts: W varies with simulated time. They are not part of the report's model, whose wind is steady, and off by
// default. The acceleration remains a(x, v): the wind changes only between two steps, so all stages of a step use one
// wind.
//
// Simulation::advance_part gives the engine another W between steps, so engines, methods and formulas need no code for
// gusts. If gusts are off, they cost one comparison for each call of advance.

/// Whether the wind of this preset varies.
inline bool gusts(const Preset& preset) {
  return preset.gust > 0 && preset.W != glm::dvec3(0) && preset.kind == Kind::cloth;
}

/// The gusts at time t (s) relative to their strength, -1 to 1: a sum of three sines whose periods, the longest of
/// which is `period` (s), have no common multiple. The mean is 0.
double gust_wave(double t, double period);

/// The wind over the next steps.
struct GustSpan {
  double factor = 1;  ///< of W
  int steps = 1;      ///< of dt for which the factor holds, at least 1
};
/// At time t (s). The wave is sampled in the middle of each 64th of a period, or of a step if dt is longer than that,
/// so that cloths of different dt have the same gusts. A step over the border of two such spans gets the mean of the
/// wind over the step.
GustSpan gust_span(const Preset& preset, double t);

/// The preset with W as it is at time t (s); unchanged if there are no gusts.
Preset in_gusts(Preset preset, double t);

}  // namespace tyglab
