// `--dt auto`: a dt that is stable for the constants as they are, and a watch over the energy that tells when it is
// not.
#pragma once

#include <optional>

#include "core/energy/ledger.h"
#include "core/model/preset.h"

namespace tyglab {

/// A dt in two digits, rounded down: a number to say and to remember.
double two_digits_below(double dt);

/// Chooses dt by linear theory, for any configuration of the springs: what is active now may change in the next step,
/// and the limit of the cloth as it hangs is then too large. One-sided springs that switch feed energy in below that
/// limit too, so the ledger is watched: where the integrator makes energy, dt is halved.
class AutoStep {
 public:
  static constexpr double margin = 0.8;    ///< of the largest stable dt
  static constexpr double longest = 0.01;  ///< s: what methods without a limit get, and the softest cloths
  static constexpr double allowed = 0.02;  ///< made energy in parts of the ledger's scale, within a second

  /// The dt for these constants, s; none where the method has no stable one.
  static std::optional<double> choose(const Preset& preset);

  /// Something else than this watch changed dt or the constants: it begins anew.
  void begin() { begun_ = false; }
  /// Looks at the ledger; returns the dt to go on with if the present one makes too much energy.
  std::optional<double> look(const Preset& preset, double t, const LedgerReading& ledger);

 private:
  bool begun_ = false;
  double t_ = 0, made_ = 0;  ///< at the beginning of the present second, s and J
};

}  // namespace tyglab
