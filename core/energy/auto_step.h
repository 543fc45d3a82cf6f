// `--dt auto` chooses a dt that is stable for the present constants, and reduces it if the energy shows that it is not.
#pragma once

#include <limits>
#include <optional>

#include "core/energy/ledger.h"
#include "core/model/preset.h"

namespace tyglab {

/// A dt rounded down to two digits, which are easy to read and remember.
double two_digits_below(double dt);

/// Chooses dt by linear theory, for any configuration of the springs: what is active now may change in the next step,
/// and the limit of the cloth as it hangs is then too large. One-sided springs that switch add energy below that limit
/// too, so the ledger is watched: if the integrator adds energy, dt is halved.
class AutoStep {
 public:
  static constexpr double margin = 0.8;    ///< of the largest stable dt
  static constexpr double longest = 0.01;  ///< s: what methods without a limit get, and the softest cloths
  static constexpr double allowed = 0.02;  ///< energy added within a second, relative to the ledger's scale

  /// The dt for this preset, s; none if the method has no stable one.
  static std::optional<double> choose(const Preset& preset);

  /// Starts again, after something other than this watch has changed dt or the constants.
  void begin() { *this = AutoStep(); }
  /// Checks the ledger; returns a smaller dt if the present one adds too much energy.
  std::optional<double> look(const Preset& preset, double t, const LedgerReading& ledger);

  /// Whether energy was added as fast after several halvings as before: then dt is not the cause, and it stays.
  bool in_vain() const { return in_vain_ >= most_in_vain; }

 private:
  static constexpr int most_in_vain = 3;
  int in_vain_ = 0;                                        ///< halvings in a row
  double rate_ = std::numeric_limits<double>::infinity();  ///< at which energy was added before the last one, W
  bool begun_ = false;
  double t_ = 0, made_ = 0;  ///< at the beginning of the present second, s and J
};

}  // namespace tyglab
