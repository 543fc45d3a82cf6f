// `tyglab bench implicit` measures the cost of an implicit step, and whether the step converged.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

struct ImplicitRow {
  Preset preset;
  int threads = 1;
  int steps = 0;           ///< that were measured
  double ms_per_step = 0;  ///< median
  double newton_per_step = 0, linear_per_step = 0;
  double residual = 0;      ///< the largest of a step, in parts of the largest force
  double strain_error = 0;  ///< of the last step's largest strain, relative to that of its exact solution
  double bytes_per_particle = 0;
  bool converged = false;  ///< every step
};

/// The hanging cloth in double, by size, stiffness and dt, smallest first. `quick`: fewer.
std::vector<Preset> implicit_cases(bool quick);

/// Makes some steps of a case, each of them measured, after a first one from rest. The method must be implicit_euler,
/// for whose last step alone the exact solution is known: it is solved again, to a residual a thousand times smaller.
ImplicitRow measure_implicit(const Preset& preset, int threads);

}  // namespace tyglab
