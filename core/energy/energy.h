// The energy of a cloth and the powers acting on it at one moment, which the ledger sums up.
#pragma once

#include <cstddef>
#include <span>

#include "core/cloth/state.h"
#include "core/engines/engine.h"
#include "core/forces/force.h"
#include "core/model/preset.h"

namespace tyglab {

/// J: kinetic energy of the particles (without the held one and driven pins), and the potential energy of each force
/// that has one. That of gravity is zero at y = 0.
struct Energy {
  double kinetic = 0;
  PerForce<double> of;
  /// That of internal forces.
  double elastic() const {
    return of.sum([](const Force& force) { return force.conserves && force.group == Force::Group::internal; });
  }
  double total() const {
    return kinetic + of.sum([](const Force& force) { return force.conserves; });
  }
};

/// W: energy that the cloth gains per second by forces that have no energy of their own, and by the hand and the pins
/// that move. That of damping is never above 0.
struct Power {
  PerForce<double> of;
  double hand = 0;
};

struct EnergyReading {
  Energy energy;
  Power power;
};

/// `state`: dense, with velocities at the time of the positions. One pass over it for each force; those of springs are
/// in SIMD where nothing is torn.
EnergyReading read_energy(const Preset& preset, const Tears& tears, const State& state, const Held& held,
                          std::span<const DrivenPin> driven = {});

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
