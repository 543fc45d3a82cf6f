#include "core/recording.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace tyglab {

/// One after another: a chain that is given back link by link from within itself would take as much stack as it is
/// long.
Recording::Node::~Node() {
  std::shared_ptr<Node> next = std::move(before);
  while (next && next.use_count() == 1) {
    std::atomic_thread_fence(std::memory_order_acquire);  // what another thread has let go of
    next = std::exchange(next->before, nullptr);
  }
}

void Recording::add(Event event) {
  assert(!last_ || last_->step <= steps_);
  last_ = std::make_shared<Node>(steps_, std::move(event), last_);
  ++size_;
}

Recording Recording::beginning() const {
  Recording part = *this;
  part.last_ = nullptr, part.size_ = 0, part.steps_ = 0;
  return part;
}

Recording Recording::until(const Entry& last, std::int64_t steps) const {
  assert(last.step <= steps && steps <= steps_);
  Recording part = *this;
  part.last_ = last.node, part.size_ = last.count, part.steps_ = steps;
  return part;
}

bool Recording::begins_with(const Recording& other) const {
  if (other.start_ != start_ || other.size_ > size_ || other.steps_ > steps_) return false;
  const Node* node = last_.get();
  const Node* after = nullptr;
  for (std::size_t n = size_; n > other.size_; --n) after = node, node = node->before.get();
  return node == other.last_.get() && (after == nullptr || after->step >= other.steps_);
}

std::vector<Recording::Entry> Recording::events() const {
  std::vector<Entry> all;
  all.reserve(size_);
  for (std::shared_ptr<Node> node = last_; node != nullptr; node = node->before)
    all.push_back({node->step, &node->event, node, size_ - all.size()});
  std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace tyglab
