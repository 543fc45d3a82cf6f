// The current experiment: the cloth, its requests, its past, its copies, its lab. There is no window, picture or Dear
// ImGui here: the window, the tests and other callers run an experiment by update() and read its results.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/base/frame_costs.h"
#include "app/base/messages.h"
#include "app/session/background_steps.h"
#include "app/session/copies.h"
#include "app/session/document.h"
#include "app/session/history.h"
#include "app/session/lab_state.h"
#include "app/session/pacing.h"
#include "app/session/recorded.h"
#include "app/session/repetition.h"
#include "app/session/requests.h"
#include "app/session/rewind.h"
#include "app/session/sleep.h"
#include "app/session/timeline.h"
#include "app/studies/studies.h"
#include "core/edit.h"
#include "core/energy/auto_step.h"
#include "core/model/effect.h"
#include "core/simulation.h"

namespace tyglab {

/// The actions on the cloth during an update, besides the requests.
struct SessionInput {
  std::optional<glm::dvec3> hand;      ///< where the hand that holds the cloth is to be at the end, m
  std::optional<edit::MoveBody> body;  ///< that is dragged: where it is to be at the end
  unsigned body_gesture = 0;           ///< the drag's, which is undone as one
  std::function<void()> after_steps;  ///< called after each step where set: a knife acts while the cloth moves under it
  bool touched = false;               ///< a tool is in use: the cloth does not fall asleep
  bool slow_motion = false;
  bool dragging = false;         ///< a constant is being dragged
  double frame_time = 1.0 / 60;  ///< s, of the display; drawing that takes longer leaves as much time for steps
};

/// Counts of events that drawing and tools must follow.
struct SessionCounts {
  std::uint64_t documents = 0;  ///< a preset was opened
  std::uint64_t cloths = 0;     ///< pictures are out of date, though revisions may be the same
  std::uint64_t copies = 0;     ///< copies were made again or are gone
  std::uint64_t copies_added = 0;
  std::uint64_t lattices = 0;  ///< the cloth has another shape
  std::uint64_t labs_begun = 0;
  std::uint64_t experiments_back = 0;  ///< the user's own is there again after a lab
  std::uint64_t lab_steps = 0;         ///< a step of a lab is set out: what it shows comes into sight
  std::uint64_t hands = 0;             ///< the hand lets go, and every tool with it
  std::uint64_t touches = 0;           ///< the cloth was grabbed or cut
};

struct Session {
  std::shared_ptr<Simulation> simulation;
  int threads = 1;           ///< of the CPU engine, at most
  bool behind_page = false;  ///< the start page is open: the motion waits
  bool scripted = false;     ///< everything is done at once, so that the same frames come on every machine
  Document document;
  History history;
  BackgroundRebuild rebuild;
  BackgroundSteps background_steps;
  Pacing pacing;
  Sleep sleep;
  Rewind rewind;
  Copies copies;
  ReferenceCurves curves;
  Recorded recorded;
  Studies studies;
  StepInspector inspector;
  LabState labs;
  Messages messages;
  FrameCosts costs;
  Timeline timeline;
  std::optional<Repetition> repetition;  ///< of an experiment, while it goes on
  std::optional<Replay> replay;          ///< of the last steps before a divergence, while it goes on
  std::optional<AutoStep> auto_dt;       ///< dt follows the constants and the ledger; none: it is the user's
  std::optional<Pins::Site> picked;
  std::vector<Request> requests;
  std::optional<Question> question;      ///< to be put to the user
  std::optional<SaveProblem> not_saved;  ///< to be shown where the user saves
  std::function<std::optional<std::string>(const std::string& texture)>
      show_texture;  ///< returns what is wrong with it

  Wants wants;  ///< of this update; labs add theirs
  SessionCounts counts;
  std::int64_t steps_made = 0;      ///< since the last update
  double now = 0;                   ///< s since the session began
  double last_change = 0;           ///< s, when constants changed last, to tell gestures apart
  double again_at = 0;              ///< s: update() wants to be called by then, though nothing moves
  bool warned_left_inside = false;  ///< that overlapping bodies keep particles inside, said once a session
  bool warned_pierced = false;      ///< that a body comes through the cloth, likewise
  int updates_unlooked = 0;         ///< since the check for that, and for energy that the method's errors added
  std::optional<Preset> energy_warning_preset;  ///< the constants at the last such warning
  bool warned_unconverged = false;  ///< that an implicit method's solves do not reach their tolerance, likewise
  bool warned_coarse = false;       ///< that the precision is too coarse for these constants, until it no longer is
  /// s of real time after which a step of an implicit method ends with what it has found; 0: no limit. It is of no
  /// preset, since the motion then depends on the machine.
  double step_limit = 0;
  bool quit = false;

  /// Goes on by that much real time (s): applies what was requested, steps, samples, checks the lab's checks, goes on
  /// with the studies that are wanted. Where memory fails, it says so and pauses. Throws EngineError only where the CPU
  /// engine itself fails.
  void update(double real_seconds, const SessionInput& input);

  /// The present moment, as studies are asked about it.
  StudyMoment study_moment() const;
  /// Whether the next update makes steps of the cloth, if any are due.
  bool goes_on() const;
  bool asleep() const { return pacing.playing && sleep.asleep(*simulation); }
  /// Whether nothing moves, and nothing is being worked out that will change the cloth.
  bool idle() const;
  const Preset& preset() const { return simulation->preset(); }
  /// The constants as they have been asked for: those of the cloth being built, or else the present one's.
  const Preset& requested_preset() const {
    return rebuild.requested_preset() != nullptr ? *rebuild.requested_preset() : preset();
  }
  void request(Request request) { requests.push_back(std::move(request)); }
  /// Waits for background steps and takes them over, with their consequences. Throws EngineError.
  void take_steps();
  /// Requests these constants.
  void propose(Preset next, unsigned gesture = 0) { request(request::Apply{edit::Change{std::move(next)}, gesture}); }

 private:
  void advance(double real_seconds, const SessionInput& input);
  void step(double real_seconds, const SessionInput& input);
  void make_steps(int due, const SessionInput& input);
  void made_steps(int steps, double seconds, double dt);
  void warn_of(const AdvanceResult& advance);
  void warn_of_precision();
};

// The only place that changes the cloth and its copies in the sandbox: edits, and their consequences in the
// window.

struct Session;

/// Applies one edit at once, or beside the frames where it takes long. Edits of one gesture (a drag of a slider) are
/// undone together; 0 stands alone. Returns whether it was taken; what speaks against it becomes a message.
bool apply_edit(Session& session, const Edit& edit, unsigned gesture = 0);
/// Gives an edit to the cloth and its copies, with no more checks or traces than they make themselves. Throws as
/// Simulation::apply.
void apply_to_all(Session& session, const Edit& edit);
/// The present state, to be restored when an action that changes the motion itself is undone.
HistoryEntry motion_entry(Session& session, std::string what);
/// Applies a change of constants to the cloth and its copies, with its consequences.
void change_and_follow(Session& session, const edit::Change& change);
/// The consequences for the session where the cloth of the constants `before` has been replaced by the present one.
/// `effects`: what has changed.
void follow_up(Session& session, const Preset& before, EffectSet effects);

// Replaces the engine if its device is lost during the run.

/// Replaces a lost device, for that reason: the CPU engine continues from the last stored state, or from the start if
/// there is none, and a message reports this. Throws EngineError if the CPU engine itself fails.
void fall_back(Session& session, const std::string& why);

}  // namespace tyglab
