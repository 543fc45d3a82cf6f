// Bounds how fast and how far particles can move, from everything that has given them energy. It detects a run that
// exploded and left no intact spring that is too long. docs/model.md, "How fast and how far", derives the bound.
//
// Let U² = Σ |v|² + 2 E/m, where E is the energy of all springs. In the exact motion, U grows by at most ∫ A dt, and U²
// in addition by at most ∫ B dt. A is the root of the sum of squares of the accelerations by weight and wind, plus the
// largest pull of the hand; B is the largest power of the damping between the hand and its neighbors. So the bound of U
// follows from the start and from time alone, and costs a few operations per step.
#pragma once

#include <cassert>
#include <glm/vec3.hpp>
#include <limits>

#include "core/cloth/lattice.h"
#include "core/model/preset.h"

namespace tyglab {

/// The motion of all particles, as measured.
struct Motion {
  double squared = 0;   ///< Σ |v|² + 2 E/m over all particles and springs, m²/s²
  double farthest = 0;  ///< largest coordinate, m
  double pushed = 0;    ///< root of the sum of squares of how far bodies are about to push particles out, m
};

class MotionLimit {
 public:
  /// Energy of the motion above which a run has diverged, over all that the scene can hold.
  static constexpr double factor = 10;

  /// Takes constants, wind and hand as they are from now on. `hand`: velocity of the held particle, m/s, 0 if there is
  /// none.
  void set_scene(const Preset& preset, const Lattice& lattice, bool held, const glm::dvec3& hand);
  /// Starts again from a motion that has been measured.
  void begin(const Motion& motion);
  /// Bodies are about to push particles out.
  void push(double distance);
  /// A step over dt, s, is made.
  void pass(double dt);

  /// Upper bound of Σ |v|² + 2 E/m, from everything that has supplied energy and from rounding, m²/s²; no exact motion
  /// exceeds it.
  double given_squared() const { return given_squared_; }
  /// Σ |v|² above which the run has diverged, m²/s².
  double most_squared() const { return most_squared_; }
  /// The largest coordinate that a particle can have, m.
  double farthest() const { return farthest_; }
  /// Whether particles may be too fast if none moves by more than half of `elongation` (max_elongation) within dt, s.
  bool may_be_exceeded(double elongation, double dt) const {
    assert(dt > 0);
    const double speed = elongation / (2 * dt);
    return particles_ * speed * speed > most_squared_;
  }
  /// The same for a step of the preset's dt.
  bool may_be_exceeded(double elongation) const { return may_be_exceeded(elongation, dt_); }
  double dt() const { return dt_; }

 private:
  void update();

  double particles_ = 0, dt_ = 1;
  double acceleration_ = 0;   ///< A, m/s²
  double damping_ = 0;        ///< B, m²/s³
  double fastest_mode_ = 0;   ///< ω of the springs in any configuration, 1/s
  double hand_squared_ = 0;   ///< |v|² of the held particle
  double reach_squared_ = 0;  ///< Σ |v|² that springs can have which are no longer than the other rule allows
  double noise_ = 0;          ///< of the velocity of all particles by rounding, over the largest coordinate, 1/s
  double begun_farthest_ = 0;
  double begun_squared_ = std::numeric_limits<double>::infinity(), gained_ = 0;  ///< U is at most √begun² + gained
  double given_squared_ = std::numeric_limits<double>::infinity();
  double most_squared_ = std::numeric_limits<double>::infinity();
  double farthest_ = std::numeric_limits<double>::infinity();
};

}  // namespace tyglab
