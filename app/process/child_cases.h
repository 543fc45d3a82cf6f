// Numbered cases in processes of their own, so that one that crashes or hangs is a result like any other.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace tyglab {

/// How a case's process ended.
struct ChildOutcome {
  std::string text;        ///< what it had to say; empty unless it came to its end
  int signal = 0;          ///< that ended it; 0: none
  bool timed_out = false;  ///< it was ended for taking too long
  double seconds = 0;      ///< that it took
};

struct ChildCases {
  std::int64_t from = 0, count = 0;
  int at_a_time = 1;
  double most_seconds = 60;                                           ///< for one case
  std::function<std::string(std::int64_t)> work = {};                 ///< in the case's own process
  std::function<void(std::int64_t, const ChildOutcome&)> ended = {};  ///< in this one, in the order of the numbers
  std::function<bool()> stop = {};                                    ///< no further case is begun once this holds
};

/// Runs them. This process must have no other threads. Throws std::runtime_error where no process can be made.
void run_child_cases(const ChildCases& cases);

}  // namespace tyglab
