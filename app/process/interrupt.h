// Ctrl-C, SIGTERM and SIGHUP (a closed terminal) end the program with a message: at once while there is nothing to
// save, cleanly during long work. On Windows: Ctrl-C, Ctrl-Break, and a closed console.
#pragma once

#include <memory>

namespace tyglab {

/// Sets the signal handlers while the object lives; afterward the former handlers are restored.
class SignalHandler {
 public:
  explicit SignalHandler(void (*handler)(int));
  ~SignalHandler();
  SignalHandler(const SignalHandler&) = delete;
  SignalHandler& operator=(const SignalHandler&) = delete;

 private:
  struct Before;
  std::unique_ptr<Before> before_;
};

/// While one lives, Ctrl-C (or SIGTERM, SIGHUP) prints a message and ends the program at once with exit code 130.
class InterruptExit {
 public:
  InterruptExit();

 private:
  SignalHandler handler_;
};

/// While one lives, the first Ctrl-C (or SIGTERM, SIGHUP) is noted instead of ending the program; the second ends it at
/// once.
class InterruptGuard {
 public:
  InterruptGuard();

  static bool interrupted();

 private:
  SignalHandler handler_;
};

}  // namespace tyglab
