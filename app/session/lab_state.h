// The current lab: its step, predictions and checks; and the list of labs.
//
// A lab file is read line by line and rejected as a whole, with the line of the error (lab_file.cpp). Presets, settings
// and words of checks are looked up at once, so a lab that was read can be played. watch_lab evaluates the checks of
// the present step in every frame (lab_check.h), and on completion stores the values with which the next step compares.
// If a step has `stop`, up_to_stop shortens the steps of the frame, so the motion pauses at exactly that simulated time
// and two runs can be compared particle by particle. While another preset than that of the step is open, the lab waits
// (lab_waits). All of this is independent of the window: tests/app/lab_play_test.cpp plays every lab without one.
#pragma once

#include <cassert>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/session/copies.h"
#include "app/session/history.h"
#include "app/session/lab.h"
#include "app/session/lab_check.h"
#include "app/session/rebuild.h"
#include "app/studies/studies.h"
#include "core/cloth/state.h"
#include "core/energy/auto_step.h"

namespace tyglab {

struct Session;

/// The values at the moment at which a lab step was completed: `before` in later steps, and the values that the step
/// itself has compared with those.
struct LabStepOutcome {
  std::map<std::string, double, std::less<>> values;
  std::optional<State> state;  ///< where a later step asks how far apart the cloth is from it
};

struct StepRecord {
  char typed[32] = "";  ///< of a prediction that is a number
  int chosen = -1;
  bool predicted = false;
  bool looked = false;             ///< constants were changed before the prediction, which therefore does not count
  std::vector<CheckState> checks;  ///< as they are now
  std::vector<CheckMemory> seen;   ///< what each remembers of the motion
  bool done = false;               ///< all held at once, at least once
  bool right = false;              ///< the prediction, once it is done
  double answer = 0;               ///< the right number then
  LabStepOutcome outcome;
};

struct LabRun {
  Lab lab;
  std::size_t step = 0;
  std::vector<StepRecord> records;
  std::string awaited;            ///< all checks hold, and this quantity's value is waited for; empty: none is
  bool show_explanation = false;  ///< it has just come: the card scrolls to it
  Preset begun;                   ///< the constants with which the present step began
  bool runs_on = false;           ///< the motion ran when the step began, and goes on once the prediction is made
  MotionWatch watch;
  const LabStep& now() const {
    assert(step < lab.steps.size());
    return lab.steps[step];
  }
  /// The card that the present step shows, or else that of the last step before it that showed one.
  std::string_view shown() const;
  StepRecord& record() {
    assert(step < records.size());
    return records[step];
  }
  const StepRecord& record() const {
    assert(step < records.size());
    return records[step];
  }
  /// Whether the present step waits for a prediction, which precedes its task.
  bool to_be_predicted() const { return now().prediction && !record().predicted && !record().done; }
};

/// The user's own experiment, set aside during a lab: the cloth itself, which does not move meanwhile.
struct KeptExperiment {
  Document document;
  Preset constants;  ///< as they were asked for: the cloth has them, or is yet to be built with them
  bool unsaved;      ///< no file has them
  std::shared_ptr<Simulation> simulation;
  Copies copies;
  History history;
  std::optional<Pins::Site> picked;
  std::optional<AutoStep> auto_dt;
  double step_limit;  ///< s
};

struct LabState {
  bool looked = false;  ///< for the files
  std::vector<Lab> list;
  std::vector<std::string> problems;  ///< of files that were refused
  std::optional<LabRun> run;
  std::optional<bool> opencl;           ///< whether there is a device; none: nobody has asked yet
  std::string opened;                   ///< label of the preset that a step opened last
  double own_speed = 1;                 ///< Pacing::speed, outside labs
  std::vector<KeptExperiment> kept;     ///< first the one before the lab; the last comes back first
  std::map<std::string, int> progress;  ///< by its name: a lab's steps that are done, up to the first that is not
  std::map<std::string, std::vector<StepRecord>> left;  ///< of labs left unfinished since the program started
};

/// A file, or else the lab of that name: one that comes with the program or of the user's folder. Throws LabError; an
/// unknown name is answered with the nearest.
std::filesystem::path find_lab_file(const std::string& name_or_file);
/// The shipped labs and those of the user's folder; `problems`: the reasons for which files were rejected.
std::vector<Lab> read_labs(std::vector<std::string>& problems);

/// The same, read at the first call; a message reports errors in a file.
const std::vector<Lab>& find_labs(Session& session);
/// The stored number of completed steps of the lab.
int steps_done(const Session& session, const Lab& lab);

/// Starts a lab where it was left, at a step that opens a preset; or at `step`, counted from 0, or at the last step
/// before it that opens one.
void begin_lab(Session& session, std::string_view label, std::optional<std::size_t> step = std::nullopt);
/// Goes to a step, and opens its preset, paused.
void enter_step(Session& session, std::size_t step);
/// Goes one step back for reading, without opening a preset.
void back_step(Session& session);
/// Opens the preset of the step again, if it has one.
void set_up_step(Session& session);
/// Leaves the lab, reports its result, and restores the experiment before it; a preset that the user has opened instead
/// of the lab's cloth stays open.
void leave_lab(Session& session);
/// Starts the next lab, and reports the result of the present one. False if there is no next lab.
bool next_lab(Session& session);
/// "“Why Euler gains energy” is done; 2 of 3 predictions were right. …", or the number of steps completed; `done`: the
/// stored number.
std::string lab_result(const LabRun& run, int done);
/// Leaves the lab, and restores the experiment that was set aside last: its cloth and copies, paused, with the undo
/// history.
void back_to_experiment(Session& session);
/// Whether the present cloth belongs to a lab, whose changes are not unsaved work.
bool no_work(const Session& session);

/// Why a typed prediction is rejected, in sentences; empty if it is accepted.
std::string refusal_of(const Prediction& asked, std::string_view typed);
/// Accepts the typed or chosen prediction. False if there is none yet, or if it is rejected.
bool predict(Session& session);
/// Records whether the prediction is right; to be called at the moment at which the step is done.
void judge_prediction(Session& session, LabRun& run);
/// Whether the machine lacks a device that the step needs, so that the step can only be read.
bool cannot_be_done(Session& session);

/// Whether another preset is open than the lab's.
bool lab_is_away(const Session& session);
/// Whether this prevents the present step: the lab then waits, and checks nothing.
bool lab_waits(const Session& session);
/// Puts the lab's cloth back: at the current step, or the last one before it that opens one.
void resume_lab(Session& session);
/// Whether the motion waits for the step's prediction, which would be none after a look at the result.
bool awaits_prediction(const Session& session);

/// The studies that the checks of the current step need.
Wants lab_wants(const Session& session);
/// Called in every update: evaluates the checks and whether the step is done.
void watch_lab(Session& session);
/// Limits the steps that are due to the time at which the lab's step stops the motion, and pauses the motion there.
int up_to_stop(const Session& session, int due);
void pause_at_stop(Session& session);

}  // namespace tyglab
