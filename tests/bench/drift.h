// `tyglab stability drift` follows the energy of every method over very many steps without damping, where the exact
// motion conserves it.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/model/preset.h"
#include "core/simulation.h"

namespace tyglab {

struct DriftCase {
  std::string scene;  ///< "taut_sheet" or "slack_sheet"
  Preset preset;
  std::int64_t steps = 0;
  double part_of_limit = 0;  ///< dt over what Verlet can take there in any configuration
};

struct DriftRow {
  DriftCase of;
  std::vector<double> t, energy;  ///< s, J; the energy less that of the start
  double motion = 0;  ///< J, largest kinetic energy in the first 2,000 steps of Verlet: what a drift is measured by
  double lowest = 0, highest = 0;  ///< J, of `energy`
  /// Change of energy over all steps by the straight line that fits best, in parts of `motion`; 0 where it diverged.
  double trend = 0;
  /// What of that the fluctuation about the line would show by chance (its standard error).
  double trend_error = 0;
  std::int64_t diverged_at = 0;  ///< step; 0: it did not
  std::int64_t unconverged = 0;  ///< solves of implicit methods
};

/// Every method on both scenes with half of Verlet's limit as dt, and Verlet with less on the slack one; `quick`: fewer
/// steps.
std::vector<DriftCase> drift_cases(bool quick);
/// Runs a case, or as far as it goes until stop() holds.
DriftRow measure_drift(const DriftCase& which, const std::function<bool()>& stop);

}  // namespace tyglab
