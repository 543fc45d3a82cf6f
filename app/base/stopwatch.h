// Measures durations: in real time, and in processor time of the current thread.
#pragma once

#include <chrono>
#include <ctime>

namespace tyglab {

struct Duration {
  double wall_s = 0, cpu_s = 0;
};

/// Adds the time from its making to its end to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(Duration& sum) : sum_(sum) {}
  ~Stopwatch() {
    sum_.wall_s += std::chrono::duration<double>(Clock::now() - start_).count();
    sum_.cpu_s += thread_cpu_s() - cpu_start_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  static double thread_cpu_s() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  }
  Duration& sum_;
  Clock::time_point start_ = Clock::now();
  double cpu_start_ = thread_cpu_s();
};

}  // namespace tyglab
