// The energy ledger tracks where a cloth's energy comes from and where it goes. The integrator added or removed the
// part that no force, contact, tear or edit explains.
//
// The ledger is kept while the Energy card is open, while dt is automatic, and for `run --ledger` and `--dt auto`
// (Simulation::enable_ledger). Then every step is examined: bands record the energy that bodies remove, the state is
// read, read_energy passes over it in SIMD, and Ledger adds up. This costs several times as much as the step itself,
// and nothing if no ledger is kept. The ledger does not change the motion by a single bit.
#pragma once

#include <array>
#include <span>

#include "core/energy/energy.h"

namespace tyglab {

/// ∫ P dt from one value per step: by the polynomial through the last five, so that where P is smooth the error of the
/// sum decreases with the fifth power of the step and never hides that of a method.
class RunningIntegral {
 public:
  /// Continues after a break with the present value: the total is kept, and no polynomial reaches across the break.
  void restart(double value);
  /// Adds the value a step of h (s) later. No polynomial reaches across a change of h.
  void add(double value, double h);
  double total() const { return closed_ + open(); }

 private:
  double open() const;
  std::array<double, 5> last_{};  ///< the latest first
  int count_ = 0;
  double h_ = 0;
  double closed_ = 0;
};

/// Work done on the cloth since the ledger began, J; negative where the cloth lost energy.
struct WorkTotals {
  PerForce<double> of;  ///< forces that have no energy of their own
  double contact = 0;   ///< with bodies: impacts and friction
  double tearing = 0;   ///< energy of springs that broke or were cut
  double hand = 0;      ///< and pins that move
  double edits = 0;     ///< jumps when constants, pins or the method change
  double total() const {
    return of.sum([](const Force&) { return true; }) + contact + tearing + hand + edits;
  }
};

/// The state of the ledger, J.
struct LedgerReading {
  Energy energy;     ///< now
  double began = 0;  ///< s, when the ledger began
  double start = 0;  ///< total then
  WorkTotals works;
  /// The scale of unexplained(): the energy that the cloth had in motion and springs, what gravity can give it over its
  /// own length, and the work of external forces, hand and edits.
  double scale = 0;
  bool bodies_move = false;  ///< so they may add energy
  /// What the integrator added (> 0) or removed.
  double unexplained() const { return energy.total() - start - works.total(); }
  /// Energy out of nothing: unexplained() and what contacts seem to have added, since bodies at rest only remove
  /// energy. (Bodies that are moved by an edit do push the cloth.)
  double made() const { return unexplained() + (works.contact > 0 && !bodies_move ? works.contact : 0); }
  /// unexplained() relative to scale; 0 if there is no scale.
  double share() const { return scale > 0 ? unexplained() / scale : 0; }
};

class Ledger {
 public:
  /// Added energy, relative to the scale, above which a warning is due. The ledger does not determine whether a run has
  /// diverged: observation does not change the run (motion_limit.h).
  static constexpr double warns_at = 0.1;

  enum class Source { hand, tearing, edits };

  /// `gravity_scale`: energy that gravity can give, J. `t`: now, s.
  void begin(const EnergyReading& now, double gravity_scale, double t);
  /// A step of h (s) has been made. `contact`, `tearing`: energy that bodies and broken springs added in it, J.
  void step(const EnergyReading& now, double h, double contact, double tearing);
  /// Something was changed between two steps, and the energy jumped to its present value.
  void edited(const EnergyReading& now, Source source);
  LedgerReading reading() const;

 private:
  void restart(const Power& power);
  Energy now_;
  double began_ = 0, start_ = 0, own_scale_ = 0;
  double contact_ = 0, tearing_ = 0, edits_ = 0, grabbed_ = 0;
  PerForce<RunningIntegral> works_;
  RunningIntegral hand_;
};

// Updates the energy ledger of a simulation after every step.

class EnergyWatch {
 public:
  void begin(const Preset& preset, const EnergyReading& now, double t);
  /// Records which springs are whole: the energy of those that break in the step is lost.
  void before_step(const Preset& preset, const Tears& tears);
  /// One step has led to `state`; `contacts`: what bodies stopped in it.
  void after_step(const Preset& preset, const Tears& tears, const State& state, const Held& held,
                  std::span<const DrivenPin> driven, std::span<const Contact> contacts);
  void edited(const EnergyReading& now, Ledger::Source source) { ledger_.edited(now, source); }
  const Ledger& ledger() const { return ledger_; }

 private:
  Ledger ledger_;
  Tears whole_;   ///< before the step, where springs may break
  State freely_;  ///< where the cloth would be without bodies
};

}  // namespace tyglab
