// A team of threads that runs one function together, with a barrier. Threads sleep between runs.
#pragma once

#include <atomic>
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

class Team {
 public:
  /// `size` threads including the caller's; at least 1.
  explicit Team(int size);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int size() const { return size_; }
  /// Runs work(0) here and work(1) … work(size - 1) on the others; returns when all are done.
  void run(const std::function<void(int)>& work);
  /// Waits until all threads have arrived. Called inside run() by all of them.
  void barrier();

 private:
  void serve(int number);

  int size_;
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<int> started_{0};   ///< runs begun; workers sleep on it
  std::atomic<int> finished_{0};  ///< runs ended
  std::atomic<int> working_{0};   ///< workers still at the present run
  std::atomic<int> waiting_{0};   ///< in the barrier
  std::atomic<int> passed_{0};    ///< barriers passed
  std::atomic<bool> closing_{false};
  std::vector<std::thread> threads_;
};

}  // namespace tyglab::cpu
