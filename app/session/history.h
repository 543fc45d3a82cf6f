// Undo and redo: the state before each action, one entry per gesture.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/lockstep.h"
#include "core/model/difference.h"
#include "core/model/preset.h"
#include "core/simulation.h"

namespace tyglab {

/// A copy that an action added or removed.
struct CopyChange {
  std::vector<Difference> differences;
  std::size_t index = 0, seat = 0;
  bool reference = false;  ///< distances were measured from it
  Lockstep::Cost cost{};
  bool diverged = false;
  /// Of a copy that was removed: its motion until then. Null: it was added.
  std::shared_ptr<const Snapshot> motion = nullptr;
};

/// The state that is restored when an action is undone or redone.
struct HistoryEntry {
  Preset constants;
  double t = 0;           ///< s, when the action was taken
  std::string what = {};  ///< "cut"; empty: the constants that differ say it
  /// For an action that changed the motion itself: the cloth at `t`. Null: the motion continues unchanged.
  std::shared_ptr<const Snapshot> state = nullptr;
  bool too_large = false;  ///< the state should be here, but is larger than all that may be kept
  std::shared_ptr<const CopyChange> copy = nullptr;  ///< null: the action was not about a copy
};

class History {
 public:
  static constexpr std::size_t most = 200;
  static constexpr std::size_t most_bytes = 96 << 20;  ///< of all states together

  /// Whether a change of this gesture is a separate entry: consecutive changes of one gesture (not 0) count as one.
  bool begins(unsigned gesture) const { return gesture == 0 || gesture != gesture_; }
  /// Stores the state before an action.
  void record(HistoryEntry before, unsigned gesture);
  /// Makes the next change a separate gesture.
  void end_gesture() { gesture_ = 0; }
  bool can_undo() const { return !undo_.empty(); }
  bool can_redo() const { return !redo_.empty(); }
  /// The state that an undo or a redo would restore; null: there is none.
  const HistoryEntry* next(bool backwards) const {
    const auto& from = backwards ? undo_ : redo_;
    return from.empty() ? nullptr : &from.back();
  }
  /// The name of the action that an undo or a redo affects, with these constants as the present ones; there must be
  /// one.
  std::string what(bool backwards, const Preset& present) const;
  /// Removes the newest entry, and stores the present state in its place on the other side; there must be one.
  HistoryEntry take(bool backwards, HistoryEntry now);
  /// The motion has gone back to `t`, s: actions since then that changed it have been undone with it.
  void go_back(double t);
  /// The constants before the first action since `t`, s; null: there was none.
  const Preset* before(double t) const;
  /// Size of everything that it stores.
  std::size_t bytes() const;
  void clear() { undo_.clear(), redo_.clear(), gesture_ = 0; }

 private:
  std::vector<HistoryEntry> undo_, redo_;
  unsigned gesture_ = 0;
};

/// A change of constants in words: "k_s 50 → 100 N/m", "dt and 3 more constants".
std::string change_in_words(const Preset& before, const Preset& after);
/// The name of the one constant that differs; empty where none or several do.
std::string only_change(const Preset& before, const Preset& after);

}  // namespace tyglab
