// Detects whether a file has changed since it was read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tyglab {

/// Of two equal ones the file has the same content, unless it was written twice between two ticks of the clock, or its
/// time was set back.
struct FileStamp {
  std::filesystem::path file;
  std::filesystem::file_time_type written;
  std::uintmax_t bytes;

  bool operator==(const FileStamp&) const = default;
};

/// None if there is no such file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

}  // namespace tyglab
