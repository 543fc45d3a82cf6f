// The energy ledger: where a cloth's energy came from and where it went. What no force, contact, tear or edit explains,
// the integrator made or ate.
//
// It is kept while the card Energy is open, while dt is automatic, and for `run --ledger` and `--dt auto`
// (Simulation::enable_ledger). Every step is then looked at: bands note what bodies stop, the state is read,
// read_energy passes over it in SIMD, Ledger adds up. That costs several times the step itself, and nothing where no
// ledger is kept. No bit of the motion depends on it.
#pragma once

#include <array>

#include "core/energy/energy.h"

namespace tyglab {

/// ∫ P dt of values that come a step apart: by the polynomial through the last five, so that the sum's own error falls
/// with the fifth power of the step where P is smooth and never hides a method's.
class RunningIntegral {
 public:
  /// Begins anew with the value of now: what is behind is kept, and no polynomial reaches over the break.
  void restart(double value);
  /// The value a step of h (s) later. All steps since restart() are of one length.
  void add(double value, double h);
  double total() const { return closed_ + open(); }

 private:
  double open() const;
  std::array<double, 5> last_{};  ///< the latest first
  int count_ = 0;
  double h_ = 0;
  double closed_ = 0;
};

/// Work done on the cloth since the ledger began, J; what it lost stands below 0.
struct WorkTotals {
  double damping = 0;
  double contact = 0;  ///< with bodies: impacts and friction
  double tearing = 0;  ///< energy of springs that broke or were cut
  double wind = 0;
  double hand = 0;
  double edits = 0;  ///< jumps by changed constants, pins, methods
  double total() const { return damping + contact + tearing + wind + hand + edits; }
};

/// What the ledger says, J.
struct LedgerReading {
  Energy energy;     ///< now
  double start = 0;  ///< of all kinds together, when the ledger began
  WorkTotals works;
  /// What unexplained() is judged by: the energy that the cloth had in motion and springs, what gravity can give it
  /// over its own length, and what wind, hand and edits have brought.
  double scale = 0;
  /// What the integrator made (above 0) or ate.
  double unexplained() const { return energy.total() - start - works.total(); }
  /// What came from nowhere: unexplained() and what contacts seem to have brought, since bodies at rest only take.
  /// (Moved ones do push the cloth.)
  double made() const { return unexplained() + (works.contact > 0 ? works.contact : 0); }
  /// unexplained() in parts of scale; 0 where there is no scale.
  double share() const { return scale > 0 ? unexplained() / scale : 0; }
};

class Ledger {
 public:
  /// Made energy, in parts of the scale: a warning is due, or the run counts as diverged.
  static constexpr double warns_at = 0.1, diverges_at = 10;

  enum class Source { hand, tearing, edits };

  /// `gravity_scale`: J, what gravity can give.
  void begin(const EnergyReading& now, double gravity_scale);
  /// A step of h (s) has been made. `contact`, `tearing`: J that bodies and broken springs brought in it.
  void step(const EnergyReading& now, double h, double contact, double tearing);
  /// Something was changed between two steps; the energy jumped to what it is now.
  void edited(const EnergyReading& now, Source source);
  LedgerReading reading() const;

 private:
  void restart(const Power& power);
  Energy now_;
  double start_ = 0, own_scale_ = 0;
  double contact_ = 0, tearing_ = 0, edits_ = 0, grabbed_ = 0;
  RunningIntegral damping_, wind_, hand_;
};

}  // namespace tyglab
