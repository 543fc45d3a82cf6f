// Files that are written completely or not at all.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string_view>

namespace tyglab {

/// A file could not be written.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Writes a file as a whole (OutputFile); "-" is a file's name here. Throws OutputError.
void write_atomically(const std::filesystem::path& file, std::string_view text);

}  // namespace tyglab
