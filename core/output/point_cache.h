// PC2: the point cache that Blender and Maya read. One file with the positions of every particle at every frame.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "core/cloth/state.h"

namespace tyglab {

/// Writes a PC2 file frame by frame. The header counts the frames that are whole, so that the file can be read however
/// the run ends.
/// Layout, little endian: "POINTCACHE2\0", int32 version 1, int32 points, float32 first frame 0, float32 frames from
/// sample to sample 1, int32 samples; then per sample x, y, z (m) of every particle in row order as float32.
class PointCache {
 public:
  /// Creates the file with no sample in it. For standard output ("-") the samples gather in a temporary file, since
  /// their number stands at the head. Throws OutputError.
  PointCache(const std::filesystem::path& file, std::int32_t points);
  /// Appends a sample. Throws OutputError.
  void add(const VectorField<double>& x);
  /// Sends standard output what was gathered for it; a file is whole already. Throws OutputError.
  void finish();
  std::int32_t samples() const { return samples_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void put(std::string_view bytes);
  [[noreturn]] void fail() const;

  std::filesystem::path file_;
  std::unique_ptr<std::FILE, Close> out_;
  std::int32_t points_;
  std::int32_t samples_ = 0;
  std::string sample_;
};

}  // namespace tyglab
