// Reads files that a person may supply: never more than a size limit, and without blocking.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace tyglab {

/// A file cannot be read. `what()` names it and says why.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of a file; `kind` ("preset") is what it should be, of `most_bytes` at most. Throws InputError, also where
/// the name belongs to a folder, a pipe or a device.
std::string read_input(const std::filesystem::path& file, const std::string& kind, std::uintmax_t most_bytes);

}  // namespace tyglab
