// Collision of one particle with fixed bodies (2.1.5; docs/model.md, "Collision"); what it does is in
// kernels/contact.cl, which the OpenCL engine compiles too. It uses double for both precisions: few particles touch a
// body, and rounding to float would be visible as jitter.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "core/integrators/scheme.h"
#include "core/model/preset.h"

namespace tyglab {

/// A particle over one step: its position before, its stored velocity before the step's last sweep, and where the step
/// would end without bodies.
struct ContactStep {
  glm::dvec3 old_x, old_v, x, v;
};

/// How deep `x` is inside the body, m; negative outside.
double depth(const Body& body, const glm::dvec3& x);

/// 8 units in the last place of the largest of |x|, |c|, r: a bound on rounding errors, m. `epsilon` is that of the
/// state's precision.
double contact_tolerance(const Body& body, const glm::dvec3& x, double epsilon);

/// Whether a body keeps the particle from where its velocity and acceleration alone would take it within dt. Then the
/// body exerts a force that no formula gives, since contacts correct positions and velocities.
bool held_by_contact(std::span<const Body> bodies, double dt, double epsilon, const glm::dvec3& x, const glm::dvec3& v,
                     const glm::dvec3& a);

/// The rule of contacts besides the bodies (solver.contact).
struct Contacts {
  bool at_ends = false;  ///< the report's rule, which looks at the ends of steps alone
  double dt = 0;         ///< s
  double g = 0;          ///< m/s²
  double epsilon = 0;    ///< of the state's precision
  StepShape shape;       ///< of the method's steps
  double lag = 0;        ///< Scheme::lag
};
/// Of steps of that length, s, which the preset's own dt may contain several of.
Contacts contacts_of(const Preset& preset, double dt, double epsilon);
/// Whether bodies act within steps, for which velocities before the step are kept.
bool meets_within_steps(const Preset& preset);

/// Whether the step meets a body.
bool meets(std::span<const Body> bodies, const Contacts& rule, const ContactStep& step);
/// Corrects x and v of a step that meets bodies. Returns whether x is outside all of them afterwards (overlapping
/// bodies can leave it inside one).
bool collide(std::span<const Body> bodies, const Contacts& rule, ContactStep& step);

// Gusts: W and u vary with simulated time. They are not part of the report's model, whose wind is steady, and off by
// default. The acceleration remains a(x, v): the wind changes only between two steps, so all stages of a step use one
// wind.
//
// Simulation::advance_part gives the engine another W and u between steps, so engines, methods and formulas need no
// code for gusts. If gusts are off, they cost one comparison for each call of advance.

/// Whether the wind of this preset varies.
inline bool gusts(const Preset& preset) {
  return preset.gust > 0 && preset.kind == Kind::cloth &&
         (preset.W != glm::dvec3(0) || (preset.u != glm::dvec3(0) && preset.air_density > 0));
}

/// The gusts at time t (s) relative to their strength, -1 to 1: a sum of three sines whose periods, the longest of
/// which is `period` (s), have no common multiple. The mean is 0.
double gust_wave(double t, double period);

/// The wind over the next steps.
struct GustSpan {
  double factor = 1;  ///< of W and u
  int steps = 1;      ///< of dt for which the factor holds, at least 1
};
/// At time t (s). The wave is sampled in the middle of each 64th of a period, or of a step if dt is longer than that,
/// so that cloths of different dt have the same gusts. A step over the border of two such spans gets the mean of the
/// wind over the step.
GustSpan gust_span(const Preset& preset, double t);

/// The preset with W and u as they are at time t (s); unchanged if there are no gusts.
Preset in_gusts(Preset preset, double t);

}  // namespace tyglab
