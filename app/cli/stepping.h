// Steps a simulation for `run` and `render`: in batches, with progress, until it ends, diverges or receives Ctrl-C.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "app/cli/command_line.h"
#include "core/energy/auto_step.h"
#include "core/output/experiment.h"
#include "core/playback.h"
#include "core/simulation.h"

namespace tyglab {

/// The length of a run: seconds or steps, whichever was typed.
struct Length {
  std::optional<double> seconds;
  std::optional<std::int64_t> steps;

  /// Adds --seconds, and --steps where `with_steps`.
  void add_to(CLI::App& command, bool with_steps);
  /// Steps of dt; `default_seconds` where nothing was typed. Throws UsageError if they are too many to count.
  std::int64_t in_steps(double dt, double default_seconds) const;
  /// Prints a line on stderr if the seconds typed are too short for a single step of dt.
  void warn_if_too_short(double dt) const;
};

/// The steps of a run, and as many of its first dt as take the same time, for its frames.
struct RunLength {
  std::int64_t steps, of_first_dt;
};
/// As long as was typed; otherwise as the experiment is, or 4 s where there is none (null).
RunLength length_of(const Length& length, const Preset& preset, const Experiment* experiment);

/// The time at the end of each step, from the last change of dt on.
struct Timeline {
  double dt;
  std::int64_t step = 0;  ///< at which dt became this
  double t = 0;           ///< s, then
  std::int64_t step_at(double time) const;
};

/// The steps after which a frame is shown or written, `fps` to a second of simulated time; frame 0 is the start.
class FramePlan {
 public:
  /// Throws UsageError if frames would lie closer together than steps. Without `fps`: 25, or 1/dt where dt is longer.
  FramePlan(std::optional<double> fps, double dt, std::int64_t steps);
  double fps() const { return fps_; }
  std::int64_t count() const { return count_; }
  std::int64_t step_of(std::int64_t frame) const;
  /// Adapts to a changed dt; the frames keep their times.
  void follow(const Timeline& timeline) { timeline_ = timeline; }

 private:
  double fps_;
  Timeline timeline_;
  std::int64_t count_;
};

/// Whether a picture of the cloth, or a file of its state, takes longer than half a second. After Ctrl-C these are left
/// out, and Ctrl-C ends the program at once while they are made.
bool takes_long_to_show(const Simulation& simulation);
/// Ends an interrupted command whose cloth takes long: giving its memory back would take long too. `left_out`: a
/// sentence.
[[noreturn]] void end_interrupted(const std::string& left_out);

class Stepper {
 public:
  /// `auto_dt`: halves dt where the energy ledger asks for it.
  /// `playback`: of a recording, whose events are made; it must outlive the stepper. Null: there are none.
  Stepper(Simulation& simulation, std::int64_t steps, const std::string& what, bool auto_dt = false,
          Playback* playback = nullptr);
  /// Advances to that step. False if it ended before: diverged, interrupted, or dt has changed (changed()).
  bool advance_to(std::int64_t step);
  /// Whether dt has changed since the last call, so that plans in steps must be made again.
  bool changed();
  const Timeline& timeline() const { return timeline_; }
  /// Steps made since the run began, restarts included.
  std::int64_t made() const { return simulation_.past().steps(); }
  /// The step with which the run ends.
  std::int64_t end() const { return steps_; }
  bool interrupted() const { return interrupted_; }
  /// Wall time of the stepping alone, s.
  double seconds() const { return seconds_; }

 private:
  void advance_portion(std::int64_t step);
  bool ended() const {
    return simulation_.divergence() && !(playback_ != nullptr && playback_->due(simulation_) != nullptr);
  }
  void make_events();
  void look_at_ledger();
  void look_at_precision();

  Simulation& simulation_;
  std::int64_t steps_;
  double end_time_;  ///< s
  Timeline timeline_;
  std::optional<AutoStep> auto_;
  Playback* playback_;
  bool changed_ = false;
  Progress progress_;
  std::int64_t portion_ = 1;
  double seconds_ = 0;
  bool interrupted_ = false;
  bool said_precision_ = false;  ///< that it is too coarse
};

}  // namespace tyglab
