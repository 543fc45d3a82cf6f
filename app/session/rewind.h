// The cloth's recent past, in limited memory, so a divergence costs a second and not the session.
//
// ← goes back one second and keeps the present constants; after a divergence the banner offers to continue from there
// with a smaller dt or another method. A restart, another lattice or another preset clears the past.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "core/engines/engine.h"
#include "core/simulation.h"
#include "core/step_trace.h"

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
  /// The same, but only since the last change of the cloth or its constants, so that the same motion follows.
  const Snapshot* unchanged_before(const Simulation& simulation, double t, double seconds) const;
  /// Goes back to a snapshot, and discards later ones.
  void go_back(Simulation& simulation, const Snapshot& then);
  /// Records a change of the cloth or its constants, which changes the motion from here on.
  void note_change() { changing_ = true; }
  /// Discards everything after that time (s).
  void forget_after(double t);
  void clear() { kept_.clear(), bytes_ = 0, changed_.reset(); }
  std::size_t bytes() const { return bytes_ + (changed_ ? changed_->bytes() : 0); }

 private:
  std::deque<Snapshot> kept_;  ///< oldest first
  std::size_t bytes_ = 0;
  std::optional<Snapshot> changed_;  ///< where the last change took effect
  bool changing_ = false;            ///< one takes effect in the next step
};

// Replays the last steps before a divergence slowly; at full speed an explosion lasts only a few frames.

struct Session;

struct Replay {
  static constexpr int steps = 50;
  static constexpr double lasts = 6;  ///< s, about

  Divergence of;            ///< what it leads to
  std::int64_t first = 0;   ///< the step with which it begins
  std::int64_t at = 0;      ///< the step to which it has come
  double speed = 0;         ///< of the replay
  double former_speed = 0;  ///< to go on with afterwards
};

/// Why there is nothing to replay, a sentence; empty if there is.
std::string nothing_to_replay(const Session& session);
/// Goes back to shortly before the divergence, and on from there slowly. What was asked for meanwhile stays.
void begin_replay(Session& session);
/// Ends it where it has come to its divergence, passed it, or been left by a restart. Called after the steps of a
/// frame.
void watch_replay(Session& session);

// Writes out the picked particle's next step while a card shows it.

struct Session;

class StepInspector {
 public:
  static constexpr int largest = 256 * 256;  ///< particles of a cloth whose step is written out

  /// Called in every update in which it is wanted. The step that the cloth would make next; of a moving cloth the one
  /// of some updates ago, since nobody could read it faster.
  void update(const Session& session);
  /// The one worked out last; nullptr where there is none to show.
  const StepTrace* shown() const { return trace_ ? &*trace_ : nullptr; }
  void drop() { trace_.reset(), revision_ = ~0ull; }

 private:
  std::optional<StepTrace> trace_;
  std::uint64_t revision_ = ~0ull;
  double looked_ = -1;  ///< s on the session's clock
};

}  // namespace tyglab
