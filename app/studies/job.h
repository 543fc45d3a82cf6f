// Background work: one thread, a result or an error at its end, and a way to stop it. All background work
// is a Job. The work reports its own progress: a Study in its findings, a step through its engine.
// Without threads, a copy of the program does long work (app/platform/platform.h), if its result can be
// sent back.
#pragma once

#include <atomic>
#include <cassert>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <variant>

#include "app/platform/platform.h"
#include "app/studies/transfer.h"
#include "core/analysis/convergence.h"
#include "core/analysis/settings_search.h"
#include "core/analysis/stability_map.h"

namespace tyglab {

/// Who comes first where processors are short: the frames, or (normal) both alike. Where the system gives no thread,
/// normal work is done at once, since somebody waits for it, and the other is refused, since it takes long.
enum class Priority { normal, below_frames };

/// The job as the work sees it. Safe to use from both threads.
class JobControl {
 public:
  /// Whether the result is no longer needed. The work checks often, and ends soon.
  bool cancelled() const { return cancelled_; }
  void cancel() { cancelled_ = true; }
  /// In a copy of the program: sends findings to the program itself. Empty in a thread, which shares its memory.
  std::function<void(std::string_view bytes)> report = {};

 private:
  std::atomic<bool> cancelled_ = false;
};

/// The reason for a missing result.
struct JobError {
  std::string what;
  bool out_of_memory = false;
};
/// What has just been caught, as an error. Takes no memory where that is what failed.
inline JobError caught_error() noexcept {
  JobError no_memory{"Out of memory", true};
  try {
    throw;
  } catch (const std::bad_alloc&) {
  } catch (const std::exception& error) {
    try {
      return {error.what()};
    } catch (const std::bad_alloc&) {
    }
  }
  return no_memory;
}

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

  /// Begins `work(JobControl&) -> Result`. What was being done is cancelled and joined first. `take` is called with
  /// what a copy of the program reports. Throws std::bad_alloc.
  template <class Work>
  void start(Priority priority, Work work, Copy::Report take = {}) {
    stop();
    auto state = std::make_unique<Running<Work>>(std::move(work));
    if constexpr (Transferable<Result>) {
      if (priority == Priority::below_frames && works_in_copies()) {
        state->run_in_copy(std::move(take));
        state_ = std::move(state);
        return;
      }
    }
    try {
      state->thread = std::thread([&state = *state, priority] {
        if (priority == Priority::below_frames) run_below_frames();
        state.run();
      });
    } catch (const std::system_error&) {
      priority == Priority::normal ? state->run() : state->refuse();
    }
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
  /// Whether the worker is still running.
  bool working() const { return state_ && !state_->ended; }
  void cancel() {
    if (!state_) return;
    state_->control.cancel();
    if (state_->copy && !state_->ended) state_->end_copy();
  }
  /// Waits for the end and gives the outcome; busy() must hold.
  Outcome take() {
    assert(busy());
    const std::unique_ptr<State> state = std::move(state_);
    if (state->thread.joinable()) state->thread.join();
    return std::move(*state->outcome);
  }
  /// Cancels, and waits for the end; the outcome is forgotten.
  void stop() {
    if (!state_) return;
    state_->control.cancel();
    if (state_->thread.joinable()) state_->thread.join();
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
    std::optional<Copy> copy;

    void finish() {
      const std::lock_guard lock(mutex);
      ended = true;
      end.notify_all();
    }
    /// In the middle of its work.
    void end_copy() {
      copy.reset();
      outcome.emplace(JobError{"Cancelled"});
      finish();
    }
  };
  template <class Work>
  struct Running : State {
    explicit Running(Work given) : work(std::move(given)) {}
    void run() {
      try {
        this->outcome.emplace(work(this->control));
      } catch (...) {
        this->outcome.emplace(caught_error());
      }
      this->finish();
    }
    /// What comes back are reports, marked 'r', and at last the result, 'o', or why there is none, 'e'.
    void run_in_copy(Copy::Report take) {
      const auto send = [this](const Copy::Report& report) {
        this->control.report = [&report](std::string_view bytes) { report("r" + std::string(bytes)); };
        run();
        if (const auto* result = std::get_if<Result>(&*this->outcome))
          report("o" + bytes_of(*result));
        else
          report("e" + std::get<JobError>(*this->outcome).what);
      };
      this->copy.emplace(send, [this, take = std::move(take)](std::string_view bytes) {
        const std::string_view rest = bytes.substr(1);
        if (bytes[0] == 'r') return take(rest);
        if (bytes[0] == 'o')
          this->outcome.emplace(from_bytes<Result>(rest));
        else
          this->outcome.emplace(JobError{std::string(rest)});
        this->copy.reset();
        this->finish();
      });
    }
    void refuse() {
      this->outcome.emplace(JobError{
          "The system can start no further thread, so this cannot be worked out; end other programs, or raise the "
          "limit (ulimit -u)."});
      this->finish();
    }
    Work work;
  };
  std::unique_ptr<State> state_;
};

/// A job with intermediate findings, which can be shown while it runs.
template <class Findings>
class Study {
 public:
  /// The data that frames and work share.
  class Shared {
   public:
    explicit Shared(Findings first) : findings_(first), seen_(std::move(first)) {}
    /// Changes the findings; only for the work.
    template <class Change>
    void update(const Change& change) {
      const std::lock_guard lock(mutex_);
      change(findings_);
      ++changes_;
      if (report) report(findings_, false);
    }
    /// In a copy of the program: sends what is known, now and then, or at once.
    std::function<void(const Findings&, bool at_once)> report;
    void send() { report(findings_, true); }
    /// What is known; for the frames alone. While the work is changing it, what was known before: the work may lose its
    /// processor in the middle of that, and frames wait for nothing.
    const Findings& findings() const {
      if (changes_ == seen_changes_) return seen_;
      const std::unique_lock lock(mutex_, std::try_to_lock);
      if (lock) seen_ = findings_, seen_changes_ = changes_;
      return seen_;
    }

   private:
    mutable std::mutex mutex_;
    Findings findings_;
    std::atomic<std::uint64_t> changes_ = 0;
    mutable Findings seen_;  ///< as the frames saw it last
    mutable std::uint64_t seen_changes_ = 0;
  };

  /// Begins work(Shared&, const JobControl&). What was being done is cancelled and joined first, which takes no time
  /// where working() does not hold.
  template <class Work>
  void begin(Findings first, Work work) {
    shared_ = std::make_shared<Shared>(std::move(first));
    const auto take = [shared = shared_](std::string_view bytes) {
      if constexpr (Transferable<Findings>)
        shared->update([&](Findings& findings) { findings = from_bytes<Findings>(bytes); });
    };
    const auto do_it = [shared = shared_, work = std::move(work)](JobControl& control) {
      if constexpr (Transferable<Findings>)
        if (control.report) shared->report = reporter(control);
      work(*shared, std::as_const(control));
      if (shared->report) shared->send();
      return std::monostate();
    };
    job_.start(Priority::below_frames, do_it, take);
  }
  /// Asks the work to stop; its findings are kept.
  void cancel() { job_.cancel(); }
  /// Whether the worker is still running, needed or not.
  bool working() const { return job_.working(); }
  /// Forgets what it found, and asks the work to stop. That is not waited for, since work below the frames may get no
  /// processor for seconds where others need them all; until it ends, working() holds.
  void drop() {
    job_.cancel();
    if (job_.ready()) job_.stop();
    shared_.reset();
  }
  /// What the newest work shares; null before the first.
  const std::shared_ptr<Shared>& shared() const { return shared_; }
  /// A copy of the findings; none before the first.
  std::optional<Findings> findings() const { return shared_ ? std::optional(shared_->findings()) : std::nullopt; }

 private:
  /// Sends findings ten times a second.
  static auto reporter(const JobControl& control) {
    using Clock = std::chrono::steady_clock;
    return [&control, last = Clock::time_point()](const Findings& findings, bool at_once) mutable {
      if (!at_once && Clock::now() - last < std::chrono::milliseconds(100)) return;
      last = Clock::now();
      control.report(bytes_of(findings));
    };
  }

  std::shared_ptr<Shared> shared_;
  Job<std::monostate> job_;
};

// The parts of the results of core's studies, for app/studies/transfer.h.

template <class Visit>
void visit_parts(Visit&& visit, ErrorPoint& point) {
  auto& [integrator, precision, dt, tolerance, error, cost, resolved, converged, given_up] = point;
  visit(integrator, precision, dt, tolerance, error, cost, resolved, converged, given_up);
}
template <class Visit>
void visit_parts(Visit&& visit, StudyReference& reference) {
  auto& [seconds, track, agreement, method, dt, over, blow] = reference;
  track.clear();  // for the study alone
  visit(seconds, agreement, method, dt, over, blow);
}
template <class Visit>
void visit_parts(Visit&& visit, Convergence& study) {
  auto& [of, t, seconds, reference, referenced, points, torn, done, problem] = study;
  visit(of, t, seconds, reference, referenced, points, torn, done, problem);
}
template <class Visit>
void visit_parts(Visit&& visit, MapBoundary& boundary) {
  auto& [stiffness, dt, every] = boundary;
  visit(stiffness, dt, every);
}
template <class Visit>
void visit_parts(Visit&& visit, SettingsSearch& search) {
  auto& [of, t, goal, seconds, rough, part, agreement, references, present, points, methods, methods_done, done,
         problem] = search;
  visit(of, t, goal, seconds, rough, part, agreement, references, present, points, methods, methods_done, done,
        problem);
}

}  // namespace tyglab
