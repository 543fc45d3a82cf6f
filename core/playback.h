// Repeats a recording: makes its events when they are due, and compares what it says of the positions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/recording.h"
#include "core/simulation.h"

namespace tyglab {

/// The simulation that is given to it was made from the recording's start, and nobody else changes it. As long as
/// its positions are the recorded ones, it has the beginning of that recording in place of its own.
class Playback {
 public:
  explicit Playback(Recording recording) : recording_(std::move(recording)), events_(recording_.events()) {}

  const Recording& recording() const { return recording_; }
  /// Goes on after what a simulation has in its own recording, which is the beginning of this one, or nothing.
  void begin(Simulation& simulation) {
    if (!recording_.begins_with(simulation.past())) simulation.share_recording(recording_.beginning());
    next_ = simulation.past().size();
  }
  /// Whether all has been made.
  bool over(const Simulation& simulation) const {
    return next_ == events_.size() && simulation.past().steps() >= recording_.steps();
  }
  /// Steps until the next event or the end; 0 where an event is due, or all is over.
  std::int64_t steps_to_next(const Simulation& simulation) const;
  /// The event that is due; null: none is.
  const Event* due(const Simulation& simulation) const {
    const bool there = next_ < events_.size() && events_[next_].step <= simulation.past().steps();
    return there ? events_[next_].event : nullptr;
  }
  /// What an event asks of the cloth; none of those that apply_next() makes by other means. Throws PresetError for
  /// constants that do not fit the present ones.
  static std::optional<Edit> edit_of(const Simulation& simulation, const Event& event);
  /// Makes the event that is due, or compares the positions with it. Throws as Simulation::apply, also where the cloth
  /// does not have what an event needs.
  void apply_next(Simulation& simulation);
  /// Makes up to that many steps, and all events until then; fewer if the motion diverges or is stopped. Returns how
  /// many.
  std::int64_t advance(Simulation& simulation, std::int64_t steps);

  /// How the positions compare.
  struct Comparison {
    std::int64_t compared = 0, equal_until = 0;   ///< the last step at which they were equal
    std::optional<std::int64_t> differs_at = {};  ///< and the first at which they were not
    std::int64_t looked_at = 0;                   ///< the last step at which distances were measured
    double apart = 0;                             ///< the largest of them, m
  };
  const Comparison& comparison() const { return comparison_; }

 private:
  void share(Simulation& simulation) const;
  void compare(const Simulation& simulation, const event::Hash& hash);
  void compare(const Simulation& simulation, const event::Look& look);

  Recording recording_;
  std::vector<Recording::Entry> events_;
  std::size_t next_ = 0;
  Comparison comparison_;
};

}  // namespace tyglab
