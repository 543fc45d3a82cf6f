// Ctrl-C ends long work cleanly.
#pragma once

#include <csignal>

namespace tyglab {

/// While one lives, the first Ctrl-C (or SIGTERM) is noted instead of ending the program; the second ends it at once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool interrupted();

 private:
  struct sigaction old_int_, old_term_;
};

}  // namespace tyglab
