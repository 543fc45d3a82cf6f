// A team of threads that runs one function together, with a barrier. Threads sleep between runs, and while the team is
// smaller than it may be.
#pragma once

#include <array>
#include <atomic>
#include <cassert>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

namespace tyglab::cpu {

/// How many rows a thread has finished, for the thread that follows it through the rows.
class Progress {
 public:
  void restart() { rows_ = 0; }
  void finished(int rows);
  /// Returns once that many rows are finished.
  void wait_for(int rows) const;

 private:
  alignas(64) std::atomic<int> rows_{0};  // a line of its own
};

class alignas(64) Team {
 public:
  /// `capacity` threads including the caller's; at least 1. All of them work until resize().
  explicit Team(int capacity);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int capacity() const { return int(threads_.size()) + 1; }
  /// Threads that run() uses.
  int size() const { return size_; }
  /// Between runs: 1 … capacity().
  void resize(int size) {
    assert(1 <= size && size <= capacity());
    size_ = size;
  }
  /// Runs work(0) here and work(1) … work(size - 1) on the others; returns when all are done.
  void run(const std::function<void(int)>& work);
  /// Waits until all threads have arrived. Called inside run() by all of them.
  void barrier();

 private:
  /// What a thread sleeps on until it is to run. At the end of its cache line: libstdc++ keeps count of sleepers by an
  /// address's low bits, and where there is one, each notification of a barrier or Progress would be a system call.
  struct alignas(64) Start {
    std::array<char, 60> ahead;
    std::atomic<int> runs{0};
  };

  void serve(int number);
  void start(int number);

  int size_;
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<int> finished_{0};  ///< runs ended
  std::atomic<int> working_{0};   ///< workers still at the present run
  std::atomic<int> waiting_{0};   ///< in the barrier
  std::atomic<int> passed_{0};    ///< barriers passed
  std::atomic<bool> closing_{false};
  std::vector<Start> starts_;  ///< of all but the caller
  std::vector<std::thread> threads_;
};

}  // namespace tyglab::cpu
