// Work beside the frames: one thread, a result or an error at its end, and a way to stop it. Everything that runs
// beside the frames is a Job; there is no other thread in app/.
#pragma once

#include <atomic>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <variant>

namespace tyglab {

/// Who comes first where processors are short: the frames, or (normal) both alike.
enum class Priority { normal, below_frames };

/// What the work sees of its job. Safe to use from both threads.
class JobControl {
 public:
  /// Whether the result is no longer wanted. The work looks often, and ends soon.
  bool cancelled() const { return cancelled_; }
  void cancel() { cancelled_ = true; }
  /// The part that is done, 0 to 1.
  double progress() const { return progress_; }
  void set_progress(double part) { progress_ = part; }

 private:
  std::atomic<bool> cancelled_ = false;
  std::atomic<double> progress_ = 0;
};

/// Why there is no result.
struct JobError {
  std::string what;
  bool out_of_memory = false;
};

/// Lowers the priority of the calling thread, where the system can.
void run_below_frames();
/// Whether work below the frames has a lower priority at all. Tests wait for it on machines that others use: without.
void let_work_yield(bool yields);

/// One piece of work at a time. What the work reads it must own (values, shared_ptr<const …>); it is destroyed by the
/// job's owner, never by the worker, since what it owns may belong to the owner's OpenGL context.
template <class Result>
class Job {
 public:
  using Outcome = std::variant<Result, JobError>;

  Job() = default;
  Job(Job&&) noexcept = default;
  /// Cancels and joins what this job was doing.
  Job& operator=(Job&& other) noexcept {
    stop();
    state_ = std::move(other.state_);
    return *this;
  }
  ~Job() { stop(); }

  /// Begins `work(JobControl&) -> Result`. What was being done is cancelled and joined first. Throws std::system_error
  /// where no thread can be started.
  template <class Work>
  void start(Priority priority, Work work) {
    stop();
    auto state = std::make_unique<Running<Work>>(std::move(work));
    state->thread = std::thread([&state = *state, priority] {
      if (priority == Priority::below_frames) run_below_frames();
      state.run();
    });
    state_ = std::move(state);
  }
  /// Whether work was begun whose outcome has not been taken.
  bool busy() const { return state_ != nullptr; }
  /// Whether take() need not wait.
  bool ready() const { return state_ && state_->ended; }
  /// Waits until ready(), but no longer than that, s; returns ready(). busy() must hold.
  bool wait(double seconds) const {
    std::unique_lock lock(state_->mutex);
    return state_->end.wait_for(lock, std::chrono::duration<double>(seconds), [&] { return bool(state_->ended); });
  }
  /// Whether the worker is still at it.
  bool working() const { return state_ && !state_->ended; }
  void cancel() {
    if (state_) state_->control.cancel();
  }
  double progress() const { return state_ ? state_->control.progress() : 0; }
  /// Waits for the end and gives the outcome; busy() must hold.
  Outcome take() {
    assert(busy());
    const std::unique_ptr<State> state = std::move(state_);
    state->thread.join();
    return std::move(*state->outcome);
  }
  /// Cancels, and waits for the end; the outcome is forgotten.
  void stop() {
    if (!state_) return;
    state_->control.cancel();
    state_->thread.join();
    state_.reset();
  }

 private:
  struct State {
    virtual ~State() = default;
    JobControl control;
    std::optional<Outcome> outcome;
    std::atomic<bool> ended = false;
    std::mutex mutex;
    std::condition_variable end;
    std::thread thread;
  };
  template <class Work>
  struct Running : State {
    explicit Running(Work given) : work(std::move(given)) {}
    void run() {
      try {
        this->outcome.emplace(work(this->control));
      } catch (const std::bad_alloc&) {
        this->outcome.emplace(JobError{"There is not enough memory.", true});
      } catch (const std::exception& error) {
        this->outcome.emplace(JobError{error.what()});
      }
      const std::lock_guard lock(this->mutex);
      this->ended = true;
      this->end.notify_all();
    }
    Work work;
  };
  std::unique_ptr<State> state_;
};

/// A job that fills in findings as it goes, for whoever shows them meanwhile.
template <class Findings>
class Study {
 public:
  /// What the frames and the work share.
  class Shared {
   public:
    explicit Shared(Findings first) : findings_(std::move(first)) {}
    /// Changes what is known.
    template <class Change>
    void update(const Change& change) {
      const std::lock_guard lock(mutex_);
      change(findings_);
    }
    Findings findings() const {
      const std::lock_guard lock(mutex_);
      return findings_;
    }

   private:
    mutable std::mutex mutex_;
    Findings findings_;
  };

  /// Begins work(Shared&, const JobControl&). What was being done is cancelled and joined first.
  template <class Work>
  void begin(Findings first, Work work) {
    shared_ = std::make_shared<Shared>(std::move(first));
    job_.start(Priority::below_frames, [shared = shared_, work = std::move(work)](JobControl& control) {
      work(*shared, std::as_const(control));
      return std::monostate();
    });
  }
  /// Asks the work to stop; what it has found stays.
  void cancel() { job_.cancel(); }
  bool working() const { return job_.working(); }
  /// Stops the work, waits for its end and forgets what it found.
  void drop() {
    job_.stop();
    shared_.reset();
  }
  /// What the newest work shares; null before the first.
  const std::shared_ptr<Shared>& shared() const { return shared_; }
  /// A copy of what is known; none before the first.
  std::optional<Findings> findings() const { return shared_ ? std::optional(shared_->findings()) : std::nullopt; }

 private:
  std::shared_ptr<Shared> shared_;
  Job<std::monostate> job_;
};

}  // namespace tyglab
