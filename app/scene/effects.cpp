#include "app/scene/effects.h"

#include <algorithm>

namespace tyglab {
namespace {

constexpr int settling = 8;         // frames that are not looked at after a change
constexpr double well_below = 0.7;  // of too_long_ms: who comes back must leave drawing there
constexpr int longest_wait = 64 * Effects::patience;

}  // namespace

void Effects::settle() {
  frames_ = 0, skipped_ = 0, mean_ms_ = 0;
}

void Effects::disturb() {
  settle();
  before_ms_ = 0;
}

void Effects::drew(double ms) {
  if (mode != Mode::automatic || ++skipped_ <= settling) return;
  ++frames_;
  mean_ms_ += (ms - mean_ms_) / std::min(frames_, looks);
  if (frames_ < looks) return;
  if (frames_ == looks && before_ms_ > 0 && left_out_ > 0) {
    gain_ms_[std::size_t(left_out_ - 1)] = std::max(before_ms_ - mean_ms_, 0.0);
    before_ms_ = 0;
  }
  if (mean_ms_ > too_long_ms && left_out_ < count) {
    if (brought_back_) wait_ = std::min(2 * wait_, longest_wait);
    before_ms_ = mean_ms_, brought_back_ = false;
    ++left_out_;
    settle();
  } else if (left_out_ > 0 && frames_ >= wait_ &&
             mean_ms_ + gain_ms_[std::size_t(left_out_ - 1)] < well_below * too_long_ms) {
    brought_back_ = true;
    --left_out_;
    settle();
  }
}

void Effects::apply(ViewOptions& view) const {
  const int without = left_out();
  view.soft_shadows = without < 1;
  if (without >= 2) view.samples = 1;
  if (without >= 3) view.shadows = false;
}

std::string Effects::words() const {
  static constexpr std::array<const char*, count + 1> words{"", "soft shadows", "soft shadows and smooth edges",
                                                            "shadows and smooth edges"};
  return words[std::size_t(left_out())];
}

}  // namespace tyglab
