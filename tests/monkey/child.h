// Runs of the monkey in a process of their own, so that a crash is a result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tyglab::monkey {

/// How a process ended.
struct Ending {
  bool well = false;
  std::string why;  ///< in a few words, the same each time; empty where it ended well
};

/// Runs this program with these arguments; what it says goes to `log`, and is shown where `shown`.
Ending run_child(const std::vector<std::string>& arguments, const std::filesystem::path& log, bool shown);

}  // namespace tyglab::monkey
