// What has happened to a cloth: the preset with which it began, and all that was done to it since, each at the number
// of steps that had been made. The motion follows from that to the last bit (playback.h), so a recording is an
// experiment that can be kept, sent and repeated.
//
// Recordings share their beginnings. A snapshot keeps the recording of its moment, and a motion that continues from
// the snapshot continues that recording: what came after it belongs to a branch that nobody needs any more.
#pragma once

#include <cassert>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "core/cloth/state.h"
#include "core/edit.h"

namespace tyglab {

namespace event {
/// Constants changed: settings as --set takes them; none where those of before were asked for again.
struct Change {
  std::vector<std::string> settings;
};
/// The cloth went back to what it is here, with constants that differ by these settings, and without a hand
/// (Simulation::restore). `held`: the method continued from its own variables, not from positions and velocities.
struct Resume {
  std::vector<std::string> settings;
  bool held;
};
/// Positions and velocities were replaced (Simulation::load).
struct Load {
  std::shared_ptr<const State> state;
};
/// A check of the positions (Simulation::hash).
struct Hash {
  std::uint64_t value;
};
/// Where some particles are, m: those of nine sites (Simulation::look), so that it can be told how far a repetition is
/// away.
struct Look {
  std::vector<glm::dvec3> x;
};
/// The next step diverged.
struct Diverge {};
/// A word of the user.
struct Mark {
  std::string words;
};
}  // namespace event

using Event = std::variant<event::Change, edit::Restart, edit::Grab, edit::MoveHand, edit::Release, edit::Cut,
                           edit::CutSprings, edit::Pin, edit::MoveBody, event::Resume, event::Load, event::Hash,
                           event::Look, event::Diverge, event::Mark>;

class Recording {
 public:
  /// Steps from one check of the positions to the next: 256, and in long recordings more, so that checks do not fill
  /// memory.
  static std::int64_t between_hashes(std::int64_t steps) {
    std::int64_t between = 256;
    for (std::int64_t many = 1 << 20; steps >= many && between < (1 << 30); many *= 2) between *= 2;
    return between;
  }
  static constexpr std::int64_t hashes_a_look = 16;

  struct Node;
  /// An event of it.
  struct Entry {
    std::int64_t step;
    const Event* event;
    std::shared_ptr<Node> node;  ///< keeps it
    std::size_t count;           ///< of all events to this one
  };

  explicit Recording(const Preset& start) : start_(std::make_shared<const Preset>(start)) {}

  const Preset& start() const { return *start_; }
  /// The same events after another start.
  Recording beginning_with(const Preset& start) const {
    Recording other = *this;
    other.start_ = std::make_shared<const Preset>(start);
    return other;
  }
  /// Steps since it began; restarts are in between.
  std::int64_t steps() const { return steps_; }
  void add_steps(std::int64_t steps) {
    assert(steps >= 0);
    steps_ += steps;
  }
  void add(Event event);
  /// From here on the motion depends on how fast the machine is, so that it does not repeat.
  void give_up_repeating() { repeats_ = false; }
  bool repeats() const { return repeats_; }

  /// Its start, without events and steps, and the part with all events to that one and so many steps. They share what
  /// they have with it: begins_with() finds that.
  Recording beginning() const;
  Recording until(const Entry& last, std::int64_t steps) const;
  /// Whether another one is its beginning: it has the same events, not only equal ones, and all those until its step.
  bool begins_with(const Recording& other) const;
  /// How many events it has.
  std::size_t size() const { return size_; }
  /// All events, the oldest first.
  std::vector<Entry> events() const;

 private:
  std::shared_ptr<const Preset> start_;
  std::shared_ptr<Node> last_;
  std::int64_t steps_ = 0;
  std::size_t size_ = 0;
  bool repeats_ = true;
};

/// A link of the chain of events.
struct Recording::Node {
  Node(std::int64_t at, Event what, std::shared_ptr<Node> former)
      : step(at), event(std::move(what)), before(std::move(former)) {}
  ~Node();
  std::int64_t step;
  Event event;
  std::shared_ptr<Node> before;
};

}  // namespace tyglab
