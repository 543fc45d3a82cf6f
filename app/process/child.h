// Child processes: they run a function of this program whose crash or hang is an ordinary result. Not available on
// Windows, which cannot fork.
#pragma once

#include <sys/types.h>
#include <chrono>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

// How a part of the program that ran separately ended.

namespace tyglab {

/// How a child process ended.
struct ChildExit {
  std::string result;      ///< of its function; empty unless it returned and all of the result arrived
  int code = 0;            ///< exit code: 0 unless the function threw or the result could not be sent
  int signal = 0;          ///< that ended it; 0: none
  bool timed_out = false;  ///< it was killed for taking too long
  double seconds = 0;      ///< from its start to its end
};

/// "Segmentation fault": a signal in words; on Windows an exception by its number.
std::string signal_words(int signal);

/// No child process could be created. `what()` says why.
class ChildError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ChildOptions {
  double most_seconds = 0;            ///< after which it is killed; 0: never
  double most_processor_seconds = 0;  ///< likewise, of its processor time, which does not depend on other programs
  bool silent = false;                ///< its standard output and error are discarded
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
  /// Reads available data; false once there is no more to come.
  bool read();
  /// Whether it has exceeded its time limit.
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

// Runs numbered cases in separate processes, so a crash or hang is an ordinary result; on Windows in threads of this
// process.

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

// Finds out in a child process, where these exist, whether an OpenCL driver crashes when asked for its devices.

/// Has core ask the drivers in a child process first (set_driver_probe()). On Windows they are asked in this
/// process.
void probe_drivers_in_child();

// Prints answers of drivers, which may crash.

/// Prints in a separate process, since a driver that aborts ends its process; the output of the driver itself goes to
/// driver_log(). On Windows it prints in this process. Returns the way in which the process crashed, or nothing if it
/// ended normally. Throws OutputError if not all of its output arrived.
std::string print_in_child(void (*print)());

}  // namespace tyglab
