// Long work beside the frames, at the lowest priority: it fills in what it finds as it goes, and can be dropped.
#pragma once

#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <future>
#include <memory>
#include <mutex>
#include <utility>

namespace tyglab {

template <class Findings>
class Background {
 public:
  /// What the frames and the work share.
  class Shared {
   public:
    explicit Shared(Findings first) : findings_(std::move(first)) {}
    /// Changes what is known.
    template <class Change>
    void tell(const Change& change) {
      const std::lock_guard lock(mutex_);
      change(findings_);
    }
    Findings findings() const {
      const std::lock_guard lock(mutex_);
      return findings_;
    }
    bool stopped() const { return stop_; }
    void stop() { stop_ = true; }

   private:
    mutable std::mutex mutex_;
    Findings findings_;
    std::atomic<bool> stop_ = false;
  };

  Background() = default;
  Background(Background&&) = default;
  Background& operator=(Background&&) = default;
  ~Background() { drop(); }

  /// Begins work(Shared&), which looks at stopped() often. What was in work has ended (busy).
  template <class Work>
  void begin(Findings first, Work work) {
    shared_ = std::make_shared<Shared>(std::move(first));
    work_ = std::async(std::launch::async, [shared = shared_, work = std::move(work)] {
      setpriority(PRIO_PROCESS, 0, 19);  // on Linux this thread's alone: frames come first
      work(*shared);
    });
  }
  /// Asks the work to stop; what it has found stays.
  void stop() {
    if (shared_) shared_->stop();
  }
  bool busy() const { return work_.valid() && work_.wait_for(std::chrono::seconds(0)) != std::future_status::ready; }
  /// Stops the work, waits for its end and forgets what it found.
  void drop() {
    stop();
    if (work_.valid()) work_.wait();
    work_ = {};
    shared_.reset();
  }
  /// What the newest work shares; none before the first.
  const std::shared_ptr<Shared>& shared() const { return shared_; }

 private:
  std::shared_ptr<Shared> shared_;
  std::future<void> work_;
};

}  // namespace tyglab
