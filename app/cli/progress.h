// Progress of long work with the time left: one line on stderr that is overwritten, on a terminal only.
#pragma once

#include <chrono>
#include <string>

namespace tyglab {

class Progress {
 public:
  explicit Progress(const std::string& what);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of the work, 0 to 1. Shown at most five times a second.
  void update(double done);
  /// Clears the line, for other output.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  std::string what_;
  bool terminal_;
  bool shown_ = false;
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// "5 s", "2 min 5 s", "1 h 2 min": a duration for people.
std::string duration_text(double seconds);

}  // namespace tyglab
