// `--tolerance E`: the method and the dt that reach an error soonest, by short trial runs of the very scene.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "core/analysis/error_study.h"

namespace tyglab {

/// What was typed beside the tolerance and is therefore not to be chosen.
struct ToleranceKeeps {
  bool integrator = false, precision = false;
};

struct ToleranceChoice {
  Preset preset;                    ///< with integrator, dt, precision and (where the method takes one) tolerance
  ErrorPoint chosen;                ///< what it reached in the trial
  std::vector<ErrorPoint> reached;  ///< the cheapest setting of each method that reaches the error, cheapest first
  double seconds = 0;               ///< of motion that was tried, from the start
  double agreement_rms_m = 0;       ///< how far two references differ over it
  /// What was chosen and why, as sentences.
  std::string words(double tolerance) const;
};

/// No setting reaches the tolerance; says why, and what to do.
class ToleranceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Settings with positions off by at most `tolerance` (m, root mean square over the particles) in the first `seconds`
/// of motion, or in as much of it as can be checked; half of it is aimed at. Throws ToleranceError or Stopped.
ToleranceChoice choose_for_tolerance(const Preset& preset, double tolerance, double seconds,
                                     const ToleranceKeeps& keeps, const Stop& stop);

}  // namespace tyglab
