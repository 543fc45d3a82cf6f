// The way through what has been recorded (core/recording.h): back, forth, and off it.
//
// Snapshots of the line's motion are kept at steps in between which the motion is repeated, so every step is reached to
// the last bit. Back at an earlier step, the motion repeats what was recorded (repetition.h) until the user changes
// something: from there on it is another line, and what was recorded beyond is kept as a branch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "core/recording.h"
#include "core/simulation.h"

namespace tyglab {

struct Session;

/// What stands on a timeline.
struct TimelineMark {
  enum class Kind { change, hand, cut, pin, body, restart, resume, diverged, word, branch };
  Kind kind;
  std::int64_t step;
  std::string words;
};

class Timeline {
 public:
  static constexpr std::size_t most_bytes = 96 << 20;
  static constexpr double interval = 0.5;  ///< s of simulated time between snapshots, until they are thinned out
  static constexpr std::size_t most_branches = 32;
  static constexpr std::int64_t shortest_branch = 100;  ///< steps, of what is kept

  /// A line that was left.
  struct Branch {
    Recording line;
    std::int64_t from;  ///< the step at which it was left
  };

  /// Called before the steps of a frame: keeps a snapshot if one is due.
  void look(Simulation& simulation);
  /// The latest snapshot of that line at that step or before it; null: none.
  const Snapshot* before(const Recording& line, std::int64_t step) const;
  /// The line is left at that step: forgets later snapshots, and keeps it as a branch.
  void leave(const Recording& line, std::int64_t step);
  const std::vector<Branch>& branches() const { return branches_; }
  /// Its line is the present one again, from the step at which it was left: it is no branch any more.
  void take(std::size_t branch);
  void clear() {
    kept_.clear(), branches_.clear(), marks_.clear();
    bytes_ = marked_branches_ = 0, marked_ = unmarked;
  }
  std::size_t bytes() const { return bytes_; }

  /// What stands on the timeline of a line, worked out anew a few times a second at most.
  const std::vector<TimelineMark>& marks(const Recording& line, double now);

 private:
  void forget_after(std::int64_t step);
  void thin_out();

  std::deque<Snapshot> kept_;  ///< by steps of their recordings
  std::size_t bytes_ = 0;
  std::vector<Branch> branches_;
  std::vector<TimelineMark> marks_;
  static constexpr std::size_t unmarked = std::size_t(-1);
  std::size_t marked_ = unmarked, marked_branches_ = 0;  ///< events and branches that they are of
  double marked_at_ = 0;                                 ///< s, on the session's clock
};

/// All that has been recorded of the present line, also beyond the present step.
const Recording& present_line(const Session& session);
/// The motion goes back to that step by other means, and takes another course from there.
void leave_line(Session& session, std::int64_t step);
/// Goes to a step of the line, at most to its end, or as far towards it as can be computed in that time, s. Later steps
/// are repeated from there. What speaks against it becomes a message. Returns whether it went.
bool go_to_step(Session& session, std::int64_t step, double seconds = 2);
/// Returns to the line of a branch, at the step where it was left.
void go_to_branch(Session& session, std::size_t branch);
/// By so many seconds of simulated time, below 0 backwards; 0: by a step.
void go_by(Session& session, double seconds, int steps);

}  // namespace tyglab
