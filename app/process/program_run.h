// Runs other programs to their end, without a window or a terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tyglab {

/// How another program ended.
struct ProgramExit {
  std::optional<int> code;  ///< exit code; none if it did not start or was ended by a signal
  int signal = 0;           ///< that ended it; 0: none. On Windows the exception's number
  bool timed_out = false;   ///< it was killed for taking too long
  std::string output;       ///< what it wrote to standard output and error, the first 64 KiB
};

struct ProgramOptions {
  std::string input;        ///< what it reads from its standard input
  double most_seconds = 0;  ///< after which it is killed; 0: never
};

/// Runs another program, none of whose output is seen, and waits for its end. `path` and `arguments`, which begin with
/// its name, are UTF-8.
ProgramExit run_program(const std::string& path, std::vector<std::string> arguments,
                        const ProgramOptions& options = {});

}  // namespace tyglab
