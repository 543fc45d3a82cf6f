// The moment that studies are asked about.
#pragma once

#include <algorithm>
#include <limits>

#include "core/simulation.h"

namespace tyglab {

/// The cloth now, and what a study must know to begin at a good moment.
struct StudyMoment {
  Simulation& simulation;
  double now = 0;          ///< s, the session's clock
  double last_change = 0;  ///< s on it: when constants last changed
  bool readable = true;    ///< the cloth may be read: no other thread does so
  bool dragging = false;   ///< a constant is being dragged
  double again_at =
      std::numeric_limits<double>::infinity();  ///< s on the clock: when to ask again though nothing moves

  const Preset& preset() const { return simulation.preset(); }
  /// Whether constants have stood still for a moment, since they last differed from a study's at `differ_since`.
  bool settled(double differ_since) const { return now >= std::max(differ_since, last_change) + 0.3; }
  void ask_again_in(double seconds) { again_at = std::min(again_at, now + seconds); }
};

}  // namespace tyglab
