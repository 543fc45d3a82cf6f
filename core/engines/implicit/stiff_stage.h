// Solves an implicit stage by the interior-point method (interior_point.h), on the processor and in double, for every
// engine, if Newton's method would stall or has stalled.
#pragma once

#include <cassert>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/engines/balance.h"
#include "core/engines/implicit/interior_point.h"
#include "core/engines/newton.h"
#include "core/forces/force.h"
#include "core/forces/linear_springs.h"
#include "core/integrators/scheme.h"
#include "core/model/preset.h"

namespace tyglab::implicit {

/// k_s h²/m from which on a stage is solved by the interior-point method without trying Newton's first: about where a
/// step carries springs across their rest lengths.
inline constexpr double stiff = 10;
/// From here on the linear systems, too, are solved in double.
inline constexpr double very_stiff = 1e6;
inline double stiffness_of(const Preset& preset, double h) {
  assert(h > 0 && preset.m > 0);
  return spring_constants(preset).largest() * h * h / preset.m;
}

/// The stage as an engine stores it: each array row by row, its x, then its y, then its z, `stride` numbers each.
template <class R>
struct StiffTask {
  const Preset& preset;
  Lattice lattice;
  const Tears& tears;
  std::span<const std::uint8_t> fixed;  ///< 1 at i·columns + j if fixed; empty if none is
  double h;                             ///< s
  const R *c_x, *c_v;
  const R* air;  ///< accelerations beside gravity and the wind, or null
  const R* x;    ///< positions from which to begin
  R* v;          ///< receives the solution, or the best that was found; fixed particles' is left
  std::ptrdiff_t stride;
  std::function<bool()> stops;
  std::function<bool(double best)> out_of_time;  ///< as InteriorPoint::Task has it
  std::function<void(double part)> progress;
  Crew& crew;
  double tolerance = balance_tolerance<R>;
};

class StiffStage {
 public:
  /// Whether a stage can be solved at all in this way.
  static bool possible(const Preset& preset) {
    return preset.kind == Kind::cloth && spring_constants(preset).largest() > 0;
  }
  template <class R>
  Balance solve(const StiffTask<R>& task, SolveCounts& counts);
  std::size_t bytes() const;

 private:
  template <class R, class S>
  Balance solve_with(InteriorPoint<S>& solver, const StiffTask<R>& task, SolveCounts& counts);

  LinearSprings<double> linear_;
  std::unique_ptr<InteriorPoint<float>> single_;
  std::unique_ptr<InteriorPoint<double>> double_;
};

/// Of the time that a stage may take, what this method gets unless it is nearly there by then: a method that descends
/// makes more of the rest.
inline constexpr double first_share = 0.6, nearly_there = 1e-3;
inline double stiff_share(double residual) {
  assert(!(residual < 0));
  return residual <= nearly_there ? 1 : first_share;
}

/// An implicit stage that an engine can solve in both ways.
class EitherStage : public ImplicitStage {
 public:
  virtual StageLimit limit() { return {}; }
  virtual Balance solve_by_newton() = 0;
  /// By StiffStage; then evaluates the stage there.
  virtual Balance solve_stiff() = 0;
  /// Solves as well as it can in the time that is left; after restore(), or at first.
  virtual Balance solve_quickly() { return solve_by_newton(); }
  /// Copies the present velocities.
  virtual void keep() = 0;
  /// Returns to the copy, and evaluates the stage there.
  virtual void restore() = 0;
};

/// For how many more stages the interior-point method is not tried, since it has been too slow for the limit.
struct TooSlow {
  int stages = 0;
};

/// Solves a stage in the way that is likely to be quicker, and in the other where that fails; of two failures the
/// better one is left. What is tried depends on nothing but the stage, where no time is set: a repeated step must give
/// the same bits.
Balance solve_either_way(EitherStage& stage, const Preset& preset, double h, TooSlow& too_slow);

}  // namespace tyglab::implicit
