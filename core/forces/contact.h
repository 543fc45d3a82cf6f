// Collision of one particle with bodies (2.1.5; docs/model.md, "Collision"); what it does is in
// kernels/contact.cl, which the OpenCL engine compiles too. It uses double for both precisions: few particles touch a
// body, and rounding to float would be visible as jitter.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "core/integrators/scheme.h"
#include "core/model/preset.h"

namespace tyglab {

/// A particle over one step: its position before, its stored velocity before the step's last sweep, and where the step
/// would end without bodies.
struct ContactStep {
  glm::dvec3 old_x, old_v, x, v;
};

/// A body as contacts see it in one step, from its beginning on: at a place, turned, and on a straight way. `B` is
/// double, or a device's float. Body of kernels/body.cl.
template <class B>
struct BodyAt {
  B c[3];     ///< center, or a point of a plane, m
  B axes[9];  ///< its x, its y (the normal of a plane, the axis of a cylinder) and its z, in the world
  B velocity[3], spin[3];
  B size[3];  ///< a box: half its edges; otherwise r and half the length, m
  B extent;   ///< no point is farther from the center; a plane: 0, m
  B friction, restitution;
  B reach;  ///< quick test: who is farther from the center throughout the step does not meet it; a plane: along y's
            ///< axis, m
  std::int32_t shape;
  std::int32_t turns, spins, moves;  ///< whether axes are not the world's, change, and whether any point moves
};
using PlacedBody = BodyAt<double>;
/// The same for a device.
template <class B>
BodyAt<B> body_as(const PlacedBody& from) {
  BodyAt<B> to{};
  std::copy_n(from.c, 3, to.c), std::copy_n(from.axes, 9, to.axes), std::copy_n(from.size, 3, to.size);
  std::copy_n(from.velocity, 3, to.velocity), std::copy_n(from.spin, 3, to.spin);
  to.extent = B(from.extent), to.friction = B(from.friction), to.restitution = B(from.restitution);
  to.reach = B(from.reach), to.shape = from.shape;
  to.turns = from.turns, to.spins = from.spins, to.moves = from.moves;
  return to;
}
/// The bodies over a step of dt that begins at time t, s. `epsilon`: of the precision of positions.
std::vector<PlacedBody> placed_bodies(std::span<const Body> bodies, double t, double dt, double epsilon);
/// The same into a list, which takes no memory where it has held as many.
void place_bodies(std::span<const Body> bodies, double t, double dt, double epsilon, std::vector<PlacedBody>& all);
/// A body that rests.
PlacedBody placed(const Body& body);
/// The body as it is at time t, s, at rest.
Body body_at(const Body& body, double t);
/// Whether one of them moves.
bool any_moves(std::span<const Body> bodies);

/// How deep `x` is inside the body as the step begins, m; negative outside.
double depth(const PlacedBody& body, const glm::dvec3& x);
/// Unit normal of the surface of a placed body seen from x.
glm::dvec3 body_normal(const PlacedBody& body, const glm::dvec3& x);

/// 8 units in the last place of the largest of |x|, |c| and the body's size: a bound on rounding errors, m. `epsilon`
/// is that of the state's precision.
double contact_tolerance(const PlacedBody& body, const glm::dvec3& x, double epsilon);

/// Whether a body keeps the particle from where its velocity and acceleration alone would take it within dt. Then the
/// body exerts a force that no formula gives, since contacts correct positions and velocities. `bodies`: over that dt.
bool held_by_contact(std::span<const PlacedBody> bodies, double dt, double epsilon, const glm::dvec3& x,
                     const glm::dvec3& v, const glm::dvec3& a);

/// The spacing of numbers near 1 in that precision, which contact_tolerance asks for.
double rounding_unit(Precision precision);

/// The rule of contacts besides the bodies (solver.contact).
struct Contacts {
  bool at_ends = false;  ///< the report's rule, which looks at the ends of steps alone
  double dt = 0;         ///< s
  double g = 0;          ///< m/s²
  double epsilon = 0;    ///< of the state's precision
  StepShape shape;       ///< of the method's steps
  double lag = 0;        ///< Scheme::lag
  bool upright = false;  ///< only y changes: the mass on a spring
};
/// Of steps of that length, s, which the preset's own dt may contain several of.
Contacts contacts_of(const Preset& preset, double dt, double epsilon);
/// Whether bodies act within steps, for which velocities before the step are kept.
bool meets_within_steps(const Preset& preset);

/// An impact at the end of part of a step.
struct Impact {
  int body;
  double time;  ///< s after the step began
};
/// The first impact of a particle that goes from one place and velocity to others in dt, freely, if it bounces there
/// rather than rests; `met`: whether it meets a body at all. The path between is taken to be a parabola.
std::optional<Impact> first_impact(std::span<const PlacedBody> bodies, double dt, double epsilon,
                                   const glm::dvec3& old_x, const glm::dvec3& old_v, const glm::dvec3& x, bool& met);
/// How far a particle is from a body at that time after the step began, m, and how fast it comes nearer, m/s.
struct Approach {
  double gap, rate;
};
Approach approach(const PlacedBody& body, double time, const glm::dvec3& x, const glm::dvec3& v);
/// The velocity after an impact there and then.
glm::dvec3 after_impact(const PlacedBody& body, double time, const glm::dvec3& x, const glm::dvec3& v);

/// Whether the step meets a body.
bool meets(std::span<const PlacedBody> bodies, const Contacts& rule, const ContactStep& step);
/// Corrects x and v of a step that meets bodies. Returns whether x is outside all of them afterwards (overlapping
/// bodies can leave it inside one).
bool collide(std::span<const PlacedBody> bodies, const Contacts& rule, ContactStep& step);

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
