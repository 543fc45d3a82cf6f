// `--tolerance E` finds the cheapest method and dt that keep an error, by short trial runs of the scene.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/analysis/settings_search.h"

namespace tyglab {

struct ToleranceChoice {
  Preset preset;                    ///< with integrator, dt, precision and (where the method takes one) tolerance
  ErrorPoint chosen;                ///< what it reached in the trial
  std::vector<ErrorPoint> reached;  ///< the cheapest setting of each method that reaches the error, cheapest first
  double seconds = 0;               ///< of motion that was tried, from the start
  double agreement_rms_m = 0;       ///< how far references differ over it
  /// The choice and its reason, as sentences.
  std::string words(double tolerance) const;
};

/// No setting reaches the tolerance, or whether one does is not resolved; says why.
class ToleranceError : public std::runtime_error {
 public:
  ToleranceError(const std::string& what, std::optional<double> tightest_there_is)
      : std::runtime_error(what), tightest(tightest_there_is) {}
  std::optional<double> tightest;  ///< m; the tightest tolerance that can be guaranteed here, if there is one
};

/// The settings that a search found for the tolerance, the cheapest first. Throws ToleranceError.
std::vector<ErrorPoint> reached_or_refused(const SettingsSearch& search, double tolerance);

/// Settings with positions off by at most the goal's tolerance (m, root mean square over the particles) at every time
/// of comparison in the goal's seconds of motion; of less only where the cloth is so large that all of it would take
/// too long, and nothing new happens after the end. `found` is called with the progress of the search. Throws
/// ToleranceError or Stopped.
ToleranceChoice choose_for_tolerance(const Preset& preset, const SettingsGoal& goal, const Stop& stop,
                                     const std::function<void(const SettingsSearch&)>& found);

}  // namespace tyglab
