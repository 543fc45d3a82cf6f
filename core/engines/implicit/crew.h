// The threads that solve a linear system together.
#pragma once

#include <cassert>
#include <functional>

namespace tyglab::implicit {

/// The calling thread alone; an engine that has more lends them (cpu/team_crew.h).
class Crew {
 public:
  using Work = std::function<void(int number)>;

  virtual ~Crew() = default;
  /// For the next run().
  virtual int size() const { return 1; }
  /// Calls work(0) … work(size() - 1), each on a thread of its own, the first on the caller's; returns when all are
  /// done.
  virtual void run(const Work& work) { work(0); }
  /// Within run(): waits until all have come to it.
  virtual void barrier() {}
  /// A unit of work took that long, s: whether several threads pay is seen by that.
  virtual void worked(double /*seconds*/) {}
};

/// The rows of one of a crew.
struct RowRange {
  int begin = 0, end = 0;
};
/// Of `rows` rows, the share of a thread. Every thread of a crew has one, though it may be empty.
inline RowRange share_of(int rows, int number, int size) {
  assert(rows >= 0 && number >= 0 && number < size);
  return {rows * number / size, rows * (number + 1) / size};
}

}  // namespace tyglab::implicit
