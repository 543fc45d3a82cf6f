// The energy of a cloth as it is now, and what works on it at this moment: what the ledger adds up.
#pragma once

#include "core/cloth/state.h"
#include "core/cloth/tears.h"
#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

/// J: of the particles' motion (a held one's is the hand's), of the springs (½ k (|x_ij| - rest)² while they act) and
/// of height, which is zero at y = 0.
struct Energy {
  double kinetic = 0, stretch = 0, bending = 0, gravity = 0;
  double total() const { return kinetic + stretch + bending + gravity; }
};

/// W: energy that the cloth gains per second. Damping's is never above 0; pins do no work.
struct Power {
  double damping = 0, wind = 0, hand = 0;
};

struct EnergyReading {
  Energy energy;
  Power power;
};

/// `state`: dense, velocities that belong to the positions. Needs no more than a pass over it, in SIMD where nothing is
/// torn and no wind blows.
EnergyReading read_energy(const Preset& preset, const Tears& tears, const State& state, const Held& held);

}  // namespace tyglab
