// Decides how many threads of a team work. If other programs occupy processors, threads that wait for each other lose
// time; the governor releases threads that do not pay and takes them back when they do.
#pragma once

#include <limits>
#include <vector>

namespace tyglab::cpu {

/// The number is halved at a time, from all threads down to one. The policy:
///  - Threads pay if they take at most nine tenths of the time that half as many would. How long half as many take is
///    measured by letting them work alone for a moment, at growing intervals.
///  - Threads work on credit: time beyond those nine tenths is drawn from it, time below is paid in, up to a limit.
///    So a short stall is forgiven, and a long one is not. When the credit is spent, half of the threads rest.
///  - Threads that have rested try again. They rest twice as long the next time, unless they have filled the credit.
/// It has no clock: who uses it says how long the work took. What it costs is bounded: a trial of half the threads a
/// part of the interval before it, and a trial of all of them the credit that they start with.
class ThreadGovernor {
 public:
  /// `most`: threads, at least 1; `first`: of these, at first.
  ThreadGovernor(int most, int first);
  /// For the next run.
  int threads() const { return levels_[level_].threads; }
  /// How long the next run should be at most, in seconds.
  double run_seconds() const;
  /// threads() threads have done that much work in that many seconds. A unit of work should stay as long as it
  /// is; if it becomes longer, the threads may rest once for that.
  void worked(double work, double seconds);

 private:
  struct Level {
    int threads;
    double rest;  ///< s that the threads above half of these rest, should they not pay
  };
  static constexpr double unknown = std::numeric_limits<double>::infinity();

  void measure(double work, double seconds);
  void serve(double work, double seconds);
  void serve_at(std::size_t level);
  /// Measures the level, then goes on with the one above.
  void begin_trial(std::size_t level);
  void let_go();

  std::vector<Level> levels_;  ///< from one thread to all
  std::size_t level_ = 0;
  double reference_ = unknown;  ///< s for a unit of work, of the level below
  double credit_ = 0;           ///< s
  double rest_ = 0;             ///< s until the level above tries again
  double since_trial_ = 0;      ///< s
  double interval_ = 0;         ///< between trials, in their length
  bool in_trial_ = false;
  double trial_seconds_ = 0;  ///< of the present trial or the last
  int samples_ = 0;           ///< of the present trial
  double sample_work_ = 0, sample_seconds_ = 0;
};

}  // namespace tyglab::cpu
