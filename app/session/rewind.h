// The cloth's recent past, in limited memory, so a divergence costs a second and not the session.
//
// ← goes back one second and keeps the present constants; after a divergence the banner offers to continue from there
// with a smaller dt or another method. A restart, another lattice or another preset clears the past.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "core/simulation.h"

namespace tyglab {

class Rewind {
 public:
  static constexpr double interval = 0.1;  ///< s of simulated time between snapshots
  static constexpr double longest = 30;    ///< s that are kept, at most
  static constexpr std::size_t most_bytes = 96 << 20;
  static constexpr std::size_t fewest = 10;  ///< snapshots that must fit; of a larger cloth nothing is kept

  /// Called before the steps of a frame: keeps a snapshot if one is due.
  void look(Simulation& simulation);
  /// The newest snapshot that is at least so long (s) before `t` and fits, or the oldest that fits; nullptr: none does.
  const Snapshot* before(const Simulation& simulation, double t, double seconds) const;
  /// The same, but not from before the cloth or its constants were changed last: from there the same motion follows.
  const Snapshot* unchanged_before(const Simulation& simulation, double t, double seconds) const;
  /// Goes back to one of them: what came after it is forgotten.
  void go_back(Simulation& simulation, const Snapshot& then);
  /// The cloth or its constants have been changed, and the motion is another from here on.
  void note_change() { changing_ = true; }
  /// What came after that time (s) is forgotten.
  void forget_after(double t);
  void clear() { kept_.clear(), bytes_ = 0, changed_.reset(); }
  std::size_t bytes() const { return bytes_ + (changed_ ? changed_->bytes() : 0); }

 private:
  std::deque<Snapshot> kept_;  ///< oldest first
  std::size_t bytes_ = 0;
  std::optional<Snapshot> changed_;  ///< where the last change took effect
  bool changing_ = false;            ///< one takes effect in the next step
};

}  // namespace tyglab
