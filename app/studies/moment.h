// The moment of the motion to which studies refer.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/simulation.h"

namespace tyglab {

/// Which state of which cloth: equal only where nothing has moved, been cut or been taken back in between. What a study
/// finds holds for its constants and, where it begins from the state, for that state alone.
struct MotionMark {
  std::uint64_t document = 0;  ///< the session's count of presets opened
  std::uint64_t tears = 0;     ///< Simulation::tear_revision(): cuts, tears, restarts, states brought back
  std::int64_t steps = 0;
  double t = 0;  ///< s
  bool operator==(const MotionMark&) const = default;
};

/// The cloth now, and what a study must know to begin at a good moment.
struct StudyMoment {
  Simulation& simulation;
  double now = 0;          ///< s, the session's clock
  double last_change = 0;  ///< s on it: when constants last changed
  bool readable = true;    ///< the cloth may be read: no other thread does so
  bool dragging = false;   ///< a constant is being dragged
  double again_at =
      std::numeric_limits<double>::infinity();  ///< s on the clock: when to ask again though nothing moves
  bool moving = false;                          ///< the motion runs: the state is another one in every update
  std::uint64_t document = 0;                   ///< the session's count of presets opened

  const Preset& preset() const { return simulation.preset(); }
  MotionMark mark() const { return {document, simulation.tear_revision(), simulation.steps(), simulation.time()}; }
  /// Whether constants have stood still for a moment, since they last differed from a study's at `differ_since`.
  bool settled(double differ_since) const { return now >= std::max(differ_since, last_change) + 0.3; }
  void ask_again_in(double seconds) { again_at = std::min(again_at, now + seconds); }
};

}  // namespace tyglab
