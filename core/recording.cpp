#include "core/recording.h"

#include <algorithm>
#include <utility>

namespace tyglab {

/// One after another: a chain that is given back link by link from within itself would take as much stack as it is
/// long.
Recording::Node::~Node() {
  std::shared_ptr<Node> next = std::move(before);
  while (next && next.use_count() == 1) next = std::exchange(next->before, nullptr);
}

void Recording::add(Event event) {
  assert(!last_ || last_->step <= steps_);
  last_ = std::make_shared<Node>(steps_, std::move(event), last_);
  ++size_;
}

std::vector<Recording::Entry> Recording::events() const {
  std::vector<Entry> all;
  for (const Node* node = last_.get(); node != nullptr; node = node->before.get())
    all.push_back({node->step, &node->event});
  std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace tyglab
