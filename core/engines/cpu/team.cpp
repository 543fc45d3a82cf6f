#include "core/engines/cpu/team.h"

#include <cassert>
#include <system_error>
#include <utility>

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif
#if !defined(_WIN32) && !defined(__EMSCRIPTEN__)
#include <pthread.h>
#endif

namespace tyglab::cpu {
namespace {

// A step of a small cloth takes some microseconds, so a barrier must not sleep at once; but where other programs hold
// the cores it must give them up.
constexpr int spins_before_sleep = 2000;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  _mm_pause();
#endif
}

/// How many forks this process is away from the program's start. A child has none of its parent's threads.
int forks() {
  static std::atomic<int> count{0};
#if !defined(_WIN32) && !defined(__EMSCRIPTEN__)
  static const int registered = pthread_atfork(nullptr, nullptr, [] { ++count; });
  static_cast<void>(registered);
#endif
  return count.load(std::memory_order_relaxed);
}

/// Returns once `value` is no longer `old`.
void wait_for_change(const std::atomic<int>& value, int old) {
  for (int n = 0; n < spins_before_sleep; ++n) {
    if (value.load() != old) return;
    pause();
  }
  while (value.load() == old) sleep_while(value, old);
}

}  // namespace

void Progress::finished(int rows) {
  assert(rows >= rows_.load(std::memory_order_relaxed));  // rows are never unfinished again
  rows_.store(rows, std::memory_order_release);
  wake_one(rows_);
}

void Progress::wait_for(int rows) const {
  for (int now = rows_.load(std::memory_order_acquire); now < rows; now = rows_.load(std::memory_order_acquire))
    wait_for_change(rows_, now);
}

// By way of the other constructor, so that threads which have been started are ended where memory fails.
Team::Team(int most) : Team() {
  assert(most >= 1);
  hire(most);
  size_ = capacity();
}

void Team::hire(int most) {
  forks_ = forks();
  starts_ = std::vector<Start>(std::size_t(most) - 1);
  threads_.reserve(starts_.size());
  try {
    for (int n = 1; n < most; ++n) threads_.emplace_back([this, n] { serve(n); });
  } catch (const std::system_error&) {
    // The system gives no more threads: fewer make the same bits.
  }
}

/// They can be neither used nor joined: their memory is given up.
void Team::forsake_parents() {
  if (!threads_.empty()) new std::vector<std::thread>(std::move(threads_));  // NOLINT: leaked on purpose
  threads_.clear();
}

Team::~Team() {
  if (forks_ != forks()) {
    forsake_parents();
    return;
  }
  closing_ = true;
  for (int n = 1; n < capacity(); ++n) start(n);
  for (std::thread& thread : threads_) thread.join();
}

void Team::start(int number) {
  assert(number >= 1 && std::size_t(number) <= starts_.size());
  std::atomic<int>& runs = starts_[std::size_t(number) - 1].runs;
  ++runs;
  wake_one(runs);
}

void Team::serve(int number) {
  const std::atomic<int>& runs = starts_[std::size_t(number) - 1].runs;
  for (int seen = 0;; ++seen) {
    wait_for_change(runs, seen);
    if (closing_) return;
    work(number);
    if (--working_ == 0) ++finished_, wake_all(finished_);
  }
}

void Team::work(int number) noexcept {
  assert(number >= 0 && number < size_ && call_.function != nullptr);
  try {
    call_.function(call_.work, number);
  } catch (const Failed&) {
    // Somebody else's failure.
  } catch (...) {
    if (failed_.exchange(true)) return;
    fault_ = std::current_exception();
    ++passed_, wake_all(passed_);
  }
}

void Team::run(const Call& call) {
  if (forks_ != forks()) {
    const int most = capacity();
    forsake_parents();
    hire(most);
    if (capacity() < size_)
      throw std::system_error(std::make_error_code(std::errc::resource_unavailable_try_again),
                              "The system gives this process no threads; use threads = 1");
  }
  assert(size_ > 1 && working_ == 0 && waiting_ == 0 && !failed_);
  call_ = call;
  working_ = size_ - 1;
  const int turn = finished_.load();
  for (int n = 1; n < size_; ++n) start(n);
  work(0);
  wait_for_change(finished_, turn);
  assert(working_ == 0);
  if (!failed_) return;
  failed_ = false, waiting_ = 0;
  std::rethrow_exception(std::exchange(fault_, nullptr));
}

void Team::barrier() {
  if (size_ == 1) return;
  const int turn = passed_.load();
  // Only now: who fails later lets those pass who wait for this turn.
  if (failed_) throw Failed();
  assert(waiting_ < size_);
  if (waiting_.fetch_add(1) + 1 == size_) {
    waiting_ = 0;
    passed_ = turn + 1;
    wake_all(passed_);
  } else {
    wait_for_change(passed_, turn);
  }
  if (failed_) throw Failed();
}

}  // namespace tyglab::cpu
