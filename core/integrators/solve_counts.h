// What the implicit methods' solves took, and whether they got there.
#pragma once

#include <cstdint>

namespace tyglab {

/// Work of implicit methods since the engine was created.
struct SolveCounts {
  std::int64_t newton = 0;  ///< Newton iterations
  std::int64_t linear = 0;  ///< iterations of conjugate gradients within them, or products with a constant matrix
  std::int64_t force_evaluations = 0;
  std::int64_t unconverged = 0;        ///< solves, linear or by several Newton iterations, that missed their tolerance
  std::int64_t unconverged_steps = 0;  ///< whole steps in which an implicit stage missed it
  double worst_residual = 0;           ///< of those steps, relative to the stage's initial residual; may be infinite
};

}  // namespace tyglab
