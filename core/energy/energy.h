// The energy of a cloth and the powers acting on it at one moment, which the ledger sums up.
#pragma once

#include "core/cloth/state.h"
#include "core/cloth/tears.h"
#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

/// J: kinetic energy of the particles (without the held one), potential energy of the springs (½ k (|x_ij| - rest)²
/// while they act) and of gravity, which is zero at y = 0.
struct Energy {
  double kinetic = 0, stretch = 0, bending = 0, gravity = 0;
  double total() const { return kinetic + stretch + bending + gravity; }
};

/// W: energy that the cloth gains per second. That of damping is never above 0; pins do no work.
struct Power {
  double damping = 0, wind = 0, hand = 0;
};

struct EnergyReading {
  Energy energy;
  Power power;
};

/// `state`: dense, with velocities at the time of the positions. One pass over it, in SIMD if nothing is torn and there
/// is no wind.
EnergyReading read_energy(const Preset& preset, const Tears& tears, const State& state, const Held& held);

}  // namespace tyglab
