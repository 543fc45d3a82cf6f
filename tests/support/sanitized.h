// What tests leave out under the sanitizers, where a step takes some ten times as long and threads that outnumber the
// processors mostly wait: repeats of what has been seen, never a path through the code. Other builds check the bits and
// the figures at length.
#pragma once

#include <algorithm>

namespace tyglab::test {

inline constexpr bool sanitized = TYGLAB_SANITIZED;

/// The steps or repeats that a test makes: under the sanitizers a tenth of them, but `least` at any rate.
constexpr int fewer(int n, int least = 1) {
  return sanitized ? std::min(n, std::max(n / 10, least)) : n;
}

}  // namespace tyglab::test
