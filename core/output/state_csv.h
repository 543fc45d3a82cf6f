// State files: the position and velocity of every particle, as a CSV that reproduces the numbers exactly.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/cloth/lattice.h"
#include "core/cloth/state.h"
#include "core/io/output_file.h"
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
std::string state_csv(const Tears& tears, const State& state, const StateStamp& stamp);

/// The same of what a simulation holds now.
std::string state_csv(Simulation& simulation);

// The present values of the particles as a CSV: the numbers that color the cloth.

/// A comment with t, steps and the preset's hash, then `i,j` and a column for each ParticleField with its unit, and a
/// row per particle. `reference`: what distances are measured from; null: there is no such column.
std::string values_csv(Simulation& cloth, Simulation* reference);

// PC2: the point cache of Blender and Maya, one file with the positions of every particle at every frame.

/// Writes a PC2 file frame by frame (OutputFile). The header counts the frames that are whole, so that what was written
/// can be read however the run ends.
/// Layout, little endian: "POINTCACHE2\0", int32 version 1, int32 points, float32 first frame 0, float32 frames from
/// sample to sample 1, int32 samples; then per sample x, y, z (m) of every particle in row order as float32.
class PointCache {
 public:
  /// Begins the file with no sample in it. Standard output ("-") gets all of it at the end, since the number of samples
  /// stands at the head. Throws OutputError.
  PointCache(const std::filesystem::path& file, std::int32_t points);
  /// Appends a sample. Throws OutputError.
  void add(const VectorField<double>& x);
  /// No more samples come. Throws OutputError.
  void end(Reach reach = Reach::whole) { out_.end(reach); }
  std::filesystem::path path() const { return out_.path(); }
  std::int32_t samples() const { return samples_; }

 private:
  OutputFile out_;
  std::int32_t points_;
  std::int32_t samples_ = 0;
  std::string sample_;
};

}  // namespace tyglab
