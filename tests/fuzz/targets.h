// What fuzzers feed: every reader of what comes from strangers, with what holds for any input whatever. One row each.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tyglab::fuzz {

struct Target {
  std::string_view name;
  /// Reads it. What does not hold ends the program with a sentence (std::abort), whichever fuzzer runs it.
  void (*read)(std::string_view input);
  /// Inputs to start from.
  std::vector<std::string> (*seeds)();
};

std::span<const Target> targets();

}  // namespace tyglab::fuzz
