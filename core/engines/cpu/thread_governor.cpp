#include "core/engines/cpu/thread_governor.h"

#include <algorithm>
#include <cassert>

namespace tyglab::cpu {
namespace {

constexpr double paying = 0.9;  // of the time of half the threads

// A scheduler lets a thread wait for some milliseconds: that is forgiven where threads have paid before.
constexpr double first_credit = 1e-3, most_credit = 10e-3;  // s
constexpr double first_rest = 20e-3, longest_rest = 2;      // s

// Of a trial the quickest sample counts: few threads are slowed by chance alone.
constexpr int samples_of_trial = 3;
constexpr double sample_seconds = 0.15e-3, long_trial = 2e-3, longest_run = 0.5e-3;
constexpr double first_interval = 20, longest_interval = 320;  // trials

}  // namespace

ThreadGovernor::ThreadGovernor(int most, int first) {
  assert(first >= 1 && most >= first);
  for (int threads = most; threads > 1; threads /= 2) levels_.push_back({threads, first_rest});
  levels_.push_back({1, first_rest});
  std::reverse(levels_.begin(), levels_.end());
  std::size_t level = levels_.size() - 1;
  assert(levels_.front().threads == 1 && levels_.back().threads == most);
  while (levels_[level].threads > first) --level;
  serve_at(level);
}

/// Without knowing what half as many would take.
void ThreadGovernor::serve_at(std::size_t level) {
  assert(level < levels_.size());
  level_ = level;
  reference_ = unknown;
  credit_ = first_credit;
  since_trial_ = trial_seconds_ = 0;
  interval_ = first_interval;
}

double ThreadGovernor::run_seconds() const {
  return in_trial_ ? sample_seconds : longest_run;
}

void ThreadGovernor::worked(double work, double seconds) {
  assert(!(seconds < 0));
  if (levels_.size() == 1 || !(work > 0)) return;
  if (in_trial_)
    measure(work, seconds);
  else
    serve(work, seconds);
}

void ThreadGovernor::begin_trial(std::size_t level) {
  assert(level + 1 < levels_.size());  // the level above it comes next
  level_ = level;
  in_trial_ = true;
  reference_ = unknown;
  trial_seconds_ = sample_work_ = sample_seconds_ = 0;
  samples_ = 0;
}

void ThreadGovernor::measure(double work, double seconds) {
  assert(in_trial_ && work > 0);
  trial_seconds_ += seconds;
  sample_work_ += work, sample_seconds_ += seconds;
  if (sample_seconds_ < sample_seconds) return;
  reference_ = std::min(reference_, sample_seconds_ / sample_work_);
  sample_work_ = sample_seconds_ = 0;
  if (++samples_ < samples_of_trial && trial_seconds_ < long_trial) return;
  in_trial_ = false;
  since_trial_ = 0;
  ++level_;
  // Those that were taken back must show that they pay before more are.
  if (rest_ <= 0 && level_ + 1 < levels_.size()) rest_ = levels_[level_ + 1].rest;
}

void ThreadGovernor::serve(double work, double seconds) {
  since_trial_ += seconds;
  rest_ -= seconds;
  if (level_ + 1 < levels_.size() && rest_ <= 0) {
    credit_ = first_credit;
    return begin_trial(level_);
  }
  if (level_ == 0) return;
  if (reference_ != unknown) credit_ = std::min(most_credit, credit_ + paying * reference_ * work - seconds);
  if (credit_ == most_credit) levels_[level_].rest = first_rest;
  if (credit_ < 0) return let_go();
  // Before the first trial the last run says how long one may become.
  const double trial = std::max({samples_of_trial * sample_seconds, trial_seconds_, 2 * seconds});
  if (since_trial_ < interval_ * trial) return;
  interval_ = std::min(2 * interval_, longest_interval);
  begin_trial(level_ - 1);
}

void ThreadGovernor::let_go() {
  assert(level_ > 0);
  rest_ = levels_[level_].rest;
  levels_[level_].rest = std::min(2 * rest_, longest_rest);
  serve_at(level_ - 1);
}

}  // namespace tyglab::cpu
