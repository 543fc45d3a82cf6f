// The springs of a row in the interior-point method (interior_point.h), in SIMD and in double. All quantities are
// lengths: forces and stiffnesses are multiplied by h²/m, damping by h/m.
#pragma once

#include <array>
#include <cstddef>

#include "core/cloth/lattice.h"

namespace tyglab::implicit {

struct BarrierConstants {
  std::array<double, stretch_directions> stretch;  ///< k h²/m of springs by direction, above 0
  double bend, damping;                            ///< h²/m times the constant of bending springs, and k_d h/m
  double L;                                        ///< m
};

/// One row. Arrays of springs have `stride` numbers for each of the directions (lattice.h) in turn, those of tensions
/// for the four of stretch springs alone; a spring to the lower left is at the column of its lower end.
struct BarrierRow {
  BarrierConstants constants;
  const double* whole;   ///< 1 where there is a spring, 0 where there is none
  const double* linear;  ///< as in LinearSprings, times h²/m; null: none
  const double *x, *c;   ///< row i of positions and of c_x, as in row_field.h; two more follow, zeros behind the last
  double *tension, *slack;
  double *d_tension, *d_slack;  ///< of the step
  std::ptrdiff_t stride;
  int columns;
};

/// Tensions and slacks for which each spring's product of the two is μ and its length is what they say.
void begin_tensions(const BarrierRow& row, double mu);

/// What the springs of a row sum up to.
struct BarrierSums {
  double products;  ///< Σ tension · slack
  double force;     ///< the largest of a spring
};

/// Raises slacks to what their springs' lengths ask for, and adds forces on rows i, i+1 and i+2: to `forces` those of
/// the model, to `right` what is on the right of the linear system for μ = 0. Writes the system's coefficients
/// (stiffness.h), each `to_stride` numbers long.
template <class R>
BarrierSums linearize_row(const BarrierRow& row, double* forces, double* right, R* coefficients,
                          std::ptrdiff_t to_stride);

/// Adds to the right side of rows i, i+1 and i+2 what it gains with μ and with the products of the last step's parts.
void correct_row(const BarrierRow& row, double mu, double* right);

/// What a step of length 1 does to the tensions and slacks of a row.
struct BarrierStep {
  double tension, slack;  ///< the largest part of any that it would take away
  /// Σ tension · d_slack, Σ slack · d_tension, Σ d_tension · d_slack
  double with_slack, with_tension, both;
};

/// Computes the step of tensions and slacks that goes with the step of positions: `step` is row i of it. `corrects`:
/// with μ and the products of the last step's parts, as in correct_row(); else with μ = 0.
BarrierStep step_row(const BarrierRow& row, const double* step, bool corrects, double mu);

/// Turns the forces on a row into its residual y - x + forces, where y is c_x + h c_v + h² F/m without springs, or 0
/// where a particle is fixed; likewise `right`. Returns the largest |residual|.
double finish_row(const double* x, const double* y, const double* free, double* forces, double* right,
                  std::ptrdiff_t stride, int columns);

}  // namespace tyglab::implicit
