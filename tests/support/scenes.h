// Presets and states that several tests start from.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/cloth/state.h"
#include "core/model/preset.h"
#include "core/simulation.h"
#include "tests/oracle/oracle.h"

namespace tyglab::test {

/// Seeded numbers that are the same on every machine and library (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  /// In [low, high).
  double uniform(double low, double high);
  /// In [0, n).
  int below(int n) { return int(next() % std::uint64_t(n)); }

 private:
  std::uint64_t state_;
};

/// A hanging cloth in double: the defaults otherwise.
Preset cloth(int rows, int columns, const std::string& integrator = "verlet");
/// The same, without gravity, pins, bending and damping: nothing moves until a test says so.
Preset quiet_cloth(int rows, int columns, const std::string& integrator = "verlet");
/// A single weight on its spring, in double.
Preset one_weight(const std::string& integrator = "verlet");

/// The preset's start with every free particle displaced by up to `amount`·L in each direction and moving at up to
/// `speed` m/s: folded, stretched and slack springs side by side.
State crumpled(const Preset& preset, std::uint64_t seed, double amount = 0.6, double speed = 0.5);
/// Puts that state into a simulation and an oracle of the same preset.
void load(Simulation& simulation, const State& state);
void load(oracle::Cloth& cloth, const State& state);

/// A cloth by the position of each particle, m.
template <class Position>
VectorField<double> shaped(const Lattice& lattice, Position position) {
  VectorField<double> x;
  x.resize(std::size_t(lattice.size()));
  for (int i = 0; i < lattice.rows; ++i)
    for (int j = 0; j < lattice.columns; ++j) {
      const glm::dvec3 at = position(i, j);
      const std::size_t p = std::size_t(i) * lattice.columns + j;
      x.x[p] = at.x, x.y[p] = at.y, x.z[p] = at.z;
    }
  return x;
}

glm::dvec3 position(const State& state, std::size_t p);
glm::dvec3 velocity(const State& state, std::size_t p);

/// Largest distance (m) between a particle of the simulation and the oracle's; NaN counts as infinitely far.
double distance(Simulation& simulation, const oracle::Cloth& cloth);
/// The same for the velocities as the method holds them, m/s.
double velocity_distance(Simulation& simulation, const oracle::Cloth& cloth);

/// Whether every position and velocity is finite.
bool all_finite(const State& state);
/// Bit for bit the same.
bool identical(const State& a, const State& b);

}  // namespace tyglab::test
