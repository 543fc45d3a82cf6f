// The simulation's energy ledger: kept only where somebody asks for it.
#include "core/simulation.h"

namespace tyglab {

EnergyReading Simulation::energy() {
  return read_energy(acting(), tears_, read(), held_);
}

void Simulation::enable_ledger(bool on) {
  if (on) watch_.emplace().begin(preset_, energy());
  if (!on) watch_.reset();
  engine_->note_contacts(on);
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
  if (divergence_) return;
  divergence_ = watch_->divergence(preset_, state_, lattice_.columns);
  if (!divergence_) return;
  divergence_->step = steps_, divergence_->t = time();
  diverged_preset_ = preset_;
}

}  // namespace tyglab
