// The book of this program: a cloth as loops over stencils, in double, one particle after another. Read it first. Every
// force of the table and every explicit method of fixed dt runs in it; the fast engines are held against it.
//
// A step is what the method's table says (scheme.h): for each sweep evaluate the force at two vectors, then replace
// vectors by sums of vectors; then bodies correct positions and velocities, and overloaded springs break.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "core/cloth/state.h"
#include "core/engines/engine.h"
#include "core/forces/contact.h"
#include "core/forces/force.h"
#include "core/forces/parted.h"
#include "core/integrators/scheme.h"

namespace tyglab::plain {

/// One vector a particle, at i·columns + j.
using Vector = std::vector<glm::dvec3>;

/// The sum of all forces on every particle, N; of external ones alone if asked for.
Vector forces(const Preset& preset, const Tears& tears, const Vector& x, const Vector& v, bool external_only = false);

struct Cloth {
  Preset preset;
  const Scheme* scheme;
  std::vector<std::uint8_t> fixed;  ///< not 0: pinned or held, so that no force moves it
  int held = -1;                    ///< the hand's particle
  /// The method's vectors: positions, velocities (or dt times these), and what else it keeps.
  std::vector<Vector> vectors;
  /// Vectors 0 and 1 are positions and velocities of one time: the method has not started.
  bool synchronized = true;

  // Of the last step:
  glm::dvec3 hand_force{0};       ///< on the held particle, N
  std::vector<Contact> contacts;  ///< what bodies stopped
  int left_inside = 0;            ///< particles that are still inside a body
  std::int64_t held_back = 0;     ///< particles whose way the guard has cut short, in all steps
  double largest = 0;             ///< component of a displacement, m; infinity where one is not finite

  /// What vector 1 is times.
  double velocity_scale() const { return !synchronized && scheme->keeps_displacement ? preset.dt : 1; }
  /// The vector with the velocities that damping sees at the beginning of a step.
  Vector& seen() { return vectors[std::size_t(synchronized ? vector_v : seen_velocity(*scheme))]; }
  const Vector& seen() const { return const_cast<Cloth*>(this)->seen(); }

  /// F/m at the positions of one vector and the velocities of another, which are `per` times its values.
  Vector accelerations(int position, int velocity, double per, const Tears& tears, bool external_only = false);
  /// `t`: when it begins, s, for bodies that move.
  void step(const Tears& tears, double t);
  /// The bodies over the step that begins then.
  std::vector<PlacedBody> bodies(double t) const;
  /// The method's own start.
  void start(const Tears& tears);
  /// Breaks the springs whose F_s exceeds F_max, but those near what is pinned or held. Returns by how much any other
  /// may grow before it breaks, m. Where the cloth parts instead, breaks none, and returns 0 if one parts it.
  double tear_overloaded(Tears& tears) const;

 private:
  void assign(const std::vector<Assignment>& assignments, const Vector& a);
  void collide(const Vector& x_before, const Vector& v_before, double t);
  void hold_back(const Tears& tears, const Vector& x_before);
};

}  // namespace tyglab::plain

namespace tyglab {

/// Why the plain engine does not compute the preset, and how to go on, a sentence without its end; empty if it does.
std::string plain_problem(const Preset& preset);
/// The plain cloth as an engine (`--engine plain`): on one thread, in double whatever the preset's precision. Throws
/// EngineError for a method that is not written out (scheme.h).
std::unique_ptr<Engine> make_plain_engine(const Preset& preset, const Lattice& lattice);

}  // namespace tyglab
