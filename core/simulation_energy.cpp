// The energy ledger of a simulation, kept only on request.
#include <utility>

#include "core/simulation.h"

namespace tyglab {

EnergyReading Simulation::energy() {
  return read_energy(acting(), tears_, read(), held_);
}

void Simulation::enable_ledger(bool on) {
  std::optional<EnergyWatch> watch;
  if (on) watch.emplace().begin(preset_, energy(), time());
  engine_->note_contacts(on);
  watch_ = std::move(watch);
}

std::optional<LedgerReading> Simulation::ledger() const {
  if (!watch_) return std::nullopt;
  return watch_->ledger().reading();
}

void Simulation::watch_edit(Ledger::Source source) {
  if (!watch_) return;
  ++revision_;
  watch_->edited(energy(), source);
}

void Simulation::watch_step() {
  ++revision_;
  watch_->after_step(acting(), tears_, read(), held_, engine_->contacts());
}

}  // namespace tyglab
