// A team of threads that run one function together, with a barrier. Threads sleep between runs, and while the team is
// smaller than its maximum. An exception in one thread ends the run of all.
#pragma once

#include <array>
#include <atomic>
#include <cassert>
#include <exception>
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
  /// `most` threads including the caller's, at least 1, or as many as the system gives. All of them work until
  /// resize(). Throws std::bad_alloc.
  explicit Team(int most);
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
  /// Runs work(0) here and work(1) … work(size - 1) on the others; returns when all are done. Throws what a thread has
  /// thrown first; the others have then left their work at a barrier, and nobody may wait for a Progress.
  template <class Work>
  void run(const Work& work) {
    if (size_ == 1) return work(0);
    run({&work, [](const void* which, int number) { (*static_cast<const Work*>(which))(number); }});
  }
  /// Waits until all threads have arrived. Called inside run() by all of them. Throws where one never will, since its
  /// work has thrown something.
  void barrier();

 private:
  /// What a thread sleeps on until it is to run. At the end of its cache line: libstdc++ keeps count of sleepers by an
  /// address's low bits, and where there is one, each notification of a barrier or Progress would be a system call.
  struct alignas(64) Start {
    std::array<char, 60> ahead;
    std::atomic<int> runs{0};
  };

  /// Somebody's work, not copied, since that would take memory.
  struct Call {
    const void* work = nullptr;
    void (*function)(const void* work, int number) = nullptr;
  };
  /// Thrown at a barrier where another thread has failed.
  struct Failed {};

  Team() = default;
  void run(const Call& call);
  void serve(int number);
  void start(int number);
  void work(int number) noexcept;
  void hire(int most);
  void forsake_parents();

  int size_ = 1;
  Call call_;
  std::atomic<int> finished_{0};  ///< runs ended
  std::atomic<int> working_{0};   ///< workers still at the present run
  std::atomic<int> waiting_{0};   ///< in the barrier
  std::atomic<int> passed_{0};    ///< barriers passed
  std::atomic<bool> closing_{false};
  std::atomic<bool> failed_{false};  ///< in this run
  std::exception_ptr fault_;         ///< what was thrown first
  int forks_ = 0;                    ///< of the process in which the threads run
  std::vector<Start> starts_;        ///< of all but the caller
  std::vector<std::thread> threads_;
};

}  // namespace tyglab::cpu

// Sleeps until a number that several threads share changes.

namespace tyglab::cpu {

/// Sleeps while `number` is `old`, until wake_one() or wake_all() is called for it. May return earlier.
void sleep_while(const std::atomic<int>& number, int old);
/// To be called after the number has changed.
void wake_one(std::atomic<int>& number);
void wake_all(std::atomic<int>& number);

}  // namespace tyglab::cpu
