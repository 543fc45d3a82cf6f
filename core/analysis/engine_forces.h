// The CPU engine's own force sweep as a function of one contiguous state. In `tyglab bench accuracy` it drives the
// integrators of another library, so they are compared with this project's integrators on identical forces.
#pragma once

#include <glm/vec3.hpp>

#include "core/engines/cpu/band.h"

namespace tyglab {

/// On one thread, for a cloth without tears, bodies and hand, or for the mass on a spring.
template <class R>
class EngineForces {
 public:
  /// Positions row by row as in row_field.h, or velocities; a state holds both, one behind the other.
  using Vector = Array<R>;

  explicit EngineForces(const Preset& preset);
  EngineForces(const EngineForces&) = delete;
  EngineForces& operator=(const EngineForces&) = delete;

  /// Elements of the positions, and of the velocities behind them.
  std::size_t half() const { return half_; }
  /// The preset's start.
  Vector start() const;
  /// dx/dt = v, dv/dt = F/m (0 for pinned particles).
  void derivative(const Vector& state, Vector& change);
  /// F/m alone, each vector of half() elements.
  void accelerations(const R* x, const R* v, R* a);
  /// Of particle i·columns + j, m.
  glm::dvec3 position(const Vector& state, int particle) const;
  std::int64_t evaluations() const { return evaluations_; }

 private:
  cpu::Cloth<R> cloth_;
  std::unique_ptr<cpu::Band<R>> band_;
  cpu::ResolvedSweep look_;
  simd::RowField<R> out_;
  Tears tears_;
  std::size_t half_;
  std::int64_t evaluations_ = 0;
};

extern template class EngineForces<float>;
extern template class EngineForces<double>;

}  // namespace tyglab
