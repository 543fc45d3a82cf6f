#include "app/session/rewind.h"

namespace tyglab {

void Rewind::look(Simulation& simulation) {
  if (simulation.divergence()) return;
  if (Snapshot::bytes(simulation.lattice()) > most_bytes / fewest) return clear();
  const double t = simulation.time();
  // A restart or another cloth: that past is another's.
  if (!kept_.empty() && (t < kept_.back().t || !simulation.fits(kept_.back()))) clear();
  if (changing_) changed_ = simulation.snapshot();
  changing_ = false;
  if (!kept_.empty() && t - kept_.back().t < interval) return;
  kept_.push_back(simulation.snapshot());
  // Of a large cloth more states count for more than the last bits of each.
  if (kept_.back().bytes() > most_bytes / fewest) kept_.back().held.reset();
  bytes_ += kept_.back().bytes();
  while (bytes_ > most_bytes || t - kept_.front().t > longest) {
    bytes_ -= kept_.front().bytes();
    kept_.pop_front();
  }
}

const Snapshot* Rewind::before(const Simulation& simulation, double t, double seconds) const {
  if (kept_.empty() || !simulation.fits(kept_.front())) return nullptr;
  for (auto at = kept_.rbegin(); at != kept_.rend(); ++at)
    if (t - at->t >= seconds) return &*at;
  return &kept_.front();
}

const Snapshot* Rewind::unchanged_before(const Simulation& simulation, double t, double seconds) const {
  const Snapshot* then = before(simulation, t, seconds);
  return then != nullptr && changed_ && changed_->t > then->t && simulation.fits(*changed_) ? &*changed_ : then;
}

void Rewind::go_back(Simulation& simulation, const Snapshot& then) {
  simulation.restore(then);
  forget_after(then.t);
}

void Rewind::forget_after(double t) {
  while (!kept_.empty() && kept_.back().t > t) {
    bytes_ -= kept_.back().bytes();
    kept_.pop_back();
  }
  if (changed_ && changed_->t > t) changed_.reset();
}

}  // namespace tyglab
