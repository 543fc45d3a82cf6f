// The energy of a cloth and the powers acting on it at one moment, which the ledger sums up.
#pragma once

#include <cstddef>

#include "core/cloth/state.h"
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

// Sums over the springs of one direction that a row of particles owns, in SIMD: the inner loop of the energy.

/// The springs of a row: particles begin <= j < end own one each, whose other end is at j + other of the same arrays.
struct SpringRow {
  const double* x[3];
  const double* v[3];
  std::ptrdiff_t other;
  int begin, end;
  double rest;  ///< m
};

struct SpringSums {
  double longer = 0;   ///< Σ (|x_ij| - rest)² over springs longer than rest, m²
  double shorter = 0;  ///< the same over shorter ones
  double speed = 0;    ///< Σ |v_j - v_i|², m²/s²
};

SpringSums spring_sums(const SpringRow& row);

}  // namespace tyglab
