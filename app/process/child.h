// Child processes: they run a function of this program whose crash or hang is an ordinary result. Not available on
// Windows, which cannot fork.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>

#include "app/process/child_exit.h"

namespace tyglab {

/// No child process could be created. `what()` says why.
class ChildError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ChildOptions {
  double most_seconds = 0;            ///< after which it is killed; 0: never
  double most_processor_seconds = 0;  ///< likewise, of what it has computed: the same however busy the machine is
  bool silent = false;                ///< what it writes to standard output and error goes nowhere
  bool interruptible = false;         ///< Ctrl-C and SIGTERM end it, as by default; otherwise it ignores Ctrl-C
};

/// A function that runs in a process of its own, a copy of this one with the calling thread alone.
class Child {
 public:
  using Work = std::function<std::string()>;

  /// Starts it. Throws ChildError.
  Child(const Work& work, const ChildOptions& options);
  Child(Child&& from) noexcept;
  Child& operator=(Child&& from) noexcept;
  ~Child();

  /// A descriptor that becomes readable when part of the result has arrived, and when the child has ended.
  int pipe() const { return pipe_; }
  /// Reads what has arrived; false once there will be no more.
  bool read();
  /// Whether it has taken longer than it may.
  bool overdue() const;
  /// Waits for its end; one that is overdue is killed. Once.
  ChildExit end();

 private:
  using Clock = std::chrono::steady_clock;
  double age() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
  double processor_seconds() const;

  pid_t process_ = -1;  ///< -1: it has ended
  int pipe_ = -1;
  double most_seconds_ = 0, most_processor_seconds_ = 0;
  Clock::time_point start_ = Clock::now();
  std::string result_;
};

/// Runs a function in a child process and waits for its end. Throws ChildError.
ChildExit run_in_child(const Child::Work& work, const ChildOptions& options = {});

}  // namespace tyglab
