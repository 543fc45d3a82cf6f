// Counts the work of implicit solves, and those that did not converge.
#pragma once

#include <cstdint>

namespace tyglab {

/// Work of implicit methods since the engine was created.
struct SolveCounts {
  std::int64_t newton = 0;  ///< iterations of Newton's method, or of the interior-point method in its place
  std::int64_t linear = 0;  ///< iterations of conjugate gradients within them, or products with a constant matrix
  std::int64_t force_evaluations = 0;
  std::int64_t unconverged = 0;  ///< steps whose forces do not balance, in any of their stages
  std::int64_t ended_early = 0;  ///< steps that ended because their time was up (Engine::limit_steps)
  double longest_limited = 0;    ///< real time of the longest step that had a limit (Engine::limit_steps), s
  double worst_residual = 0;     ///< of all steps, in parts of the largest force; may be infinite
};

}  // namespace tyglab
