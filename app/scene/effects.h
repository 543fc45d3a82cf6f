// Effects in the viewport's picture, which are left out if drawing is too slow on this machine.
#pragma once

#include <array>
#include <string>

#include "app/render/cloth_renderer.h"

namespace tyglab {

/// Effects are left out in this order, one at a time, once drawing takes longer than too_long_ms averaged over a few
/// frames; and brought back in the opposite order, if what they cost then would leave drawing well below that. An
/// effect that came back in vain stays off longer. Frames after a change of size do not count.
class Effects {
 public:
  static constexpr int count = 3;  ///< soft edges of shadows, smooth edges (multisampling), shadows at all
  static constexpr double too_long_ms = 20;
  static constexpr int looks = 15;      ///< frames in a mean
  static constexpr int patience = 240;  ///< frames before one is brought back
  enum class Mode { automatic, all, few };

  Mode mode = Mode::automatic;

  /// Records the drawing time of a frame with the effects that apply() left.
  void drew(double ms);
  /// Size or scene have changed: what was measured tells nothing any more, and the next frames settle.
  void disturb();
  /// The number of effects that are left out.
  int left_out() const { return mode == Mode::all ? 0 : mode == Mode::few ? count : left_out_; }
  void apply(ViewOptions& view) const;
  /// The effects that are turned off, "soft shadows and smooth edges"; empty if none is.
  std::string words() const;

 private:
  void settle();
  int left_out_ = 0;
  double mean_ms_ = 0, before_ms_ = 0;  ///< before the last one was left out
  std::array<double, count> gain_ms_{};
  int frames_ = 0, skipped_ = 0;
  int wait_ = patience;
  bool brought_back_ = false;  ///< the last change brought one back
};

}  // namespace tyglab
