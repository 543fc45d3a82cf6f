// Runs numbered cases in separate processes, so a crash or hang is an ordinary result; on Windows in threads of this
// process.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "app/process/child_exit.h"

namespace tyglab {

struct ChildCases {
  std::int64_t from = 0, count = 0;
  int at_a_time = 1;
  double most_processor_seconds = 60;                              ///< for one case; of real time ten times as long
  std::function<std::string(std::int64_t)> work = {};              ///< in the case's own process, or thread
  std::function<void(std::int64_t, const ChildExit&)> ended = {};  ///< in this one, in the order of the numbers
  std::function<bool()> stop = {};  ///< once this holds no case is started, and those that run in processes are ended
};

/// Runs them. This process must have no other threads. Throws ChildError if no process can be created.
void run_child_cases(const ChildCases& cases);

}  // namespace tyglab
