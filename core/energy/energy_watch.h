// Updates the energy ledger of a simulation after every step.
#pragma once

#include <span>

#include "core/energy/ledger.h"

namespace tyglab {

class EnergyWatch {
 public:
  void begin(const Preset& preset, const EnergyReading& now, double t);
  /// Records which springs are whole: the energy of those that break in the step is lost.
  void before_step(const Preset& preset, const Tears& tears);
  /// One step has led to `state`; `contacts`: what bodies stopped in it.
  void after_step(const Preset& preset, const Tears& tears, const State& state, const Held& held,
                  std::span<const Contact> contacts);
  void edited(const EnergyReading& now, Ledger::Source source) { ledger_.edited(now, source); }
  const Ledger& ledger() const { return ledger_; }

 private:
  Ledger ledger_;
  Tears whole_;   ///< before the step, where springs may break
  State freely_;  ///< where the cloth would be without bodies
};

}  // namespace tyglab
