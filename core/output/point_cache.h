// PC2: the point cache of Blender and Maya, one file with the positions of every particle at every frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/cloth/state.h"
#include "core/io/output_file.h"

namespace tyglab {

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
