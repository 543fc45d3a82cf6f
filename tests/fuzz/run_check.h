// One run of `tyglab` as a child, and whatever of it is not as documented.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/fuzz/run_case.h"

namespace tyglab::fuzz {

/// How the program ended.
struct RunExit {
  int code = -1;  ///< -1: a signal ended it
  int signal = 0;
  bool overdue = false;     ///< it took longer than its work can, and was interrupted
  bool hung = false;        ///< it did not even end then, and was killed
  double stop_seconds = 0;  ///< from an interrupt to its end
  double peak_bytes = 0;
};

/// What is wrong: `kind` stays the same where the same thing is wrong with another case.
struct Finding {
  std::string kind, what;
};

/// Whole contents; nothing of a file that is not there.
std::string file_text(const std::filesystem::path& file);

class RunChecker {
 public:
  /// `program`: tyglab. Runs it in that folder, to see what a run of a single particle needs.
  RunChecker(std::string program, const std::filesystem::path& folder);
  bool has_opencl() const { return has_opencl_; }
  /// Runs the case in a new folder at that place, and judges it.
  std::optional<Finding> check(const RunCase& one, const std::filesystem::path& folder) const;

 private:
  RunExit start(const std::filesystem::path& folder, const std::vector<std::string>& arguments, double seconds,
                std::optional<double> interrupt_after) const;
  std::optional<Finding> check_twin(const RunCase& one, const std::filesystem::path& folder) const;

  std::string program_;
  bool has_opencl_ = false;
  double base_bytes_ = 0;
};

}  // namespace tyglab::fuzz
