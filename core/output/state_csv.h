// State files: the position and velocity of every particle, as a CSV that reproduces the numbers exactly.
#pragma once

#include <cstdint>
#include <string>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/simulation.h"

namespace tyglab {

/// What the first line of a state file says.
struct StateStamp {
  double t = 0;             ///< s
  std::int64_t steps = 0;   ///< steps made since the start
  std::string preset_hash;  ///< preset_hash()
};

/// The text of a state file: a comment with the stamp, `i,j,x,y,z,vx,vy,vz`, and a row per particle with 17 significant
/// digits, in m and m/s. `state` holds the velocities as the method holds them (Simulation::read_raw).
std::string state_csv(const Lattice& lattice, const State& state, const StateStamp& stamp);

/// The same of what a simulation holds now.
std::string state_csv(Simulation& simulation);

}  // namespace tyglab
