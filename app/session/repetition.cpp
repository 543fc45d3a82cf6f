#include "app/session/repetition.h"

#include <algorithm>
#include <cassert>

#include "app/base/text.h"
#include "app/session/motion.h"
#include "app/session/session.h"
#include "core/io/preset_io.h"
#include "core/model/effect.h"
#include "core/model/words.h"

namespace tyglab {
namespace {

std::string title(const Session& session) {
  return "“" + session.document.label + "”";
}

/// Makes the event that is due, for the cloth and its copies. Throws what speaks against it.
void make_event(Session& session) {
  Playback& playback = session.repetition->playback;
  const Event event = *playback.due(*session.simulation);
  const Preset before = session.preset();
  const auto edit = Playback::edit_of(*session.simulation, event);
  playback.apply_next(*session.simulation);
  if (edit) copies_apply(session, *edit);
  if (const auto* mark = std::get_if<event::Mark>(&event)) session.messages.note("Mark: " + mark->words);
  if (std::holds_alternative<edit::Restart>(event)) session.recorded.clear();
  if (std::holds_alternative<event::Resume>(event) || std::holds_alternative<event::Load>(event))
    copies_resume(session), session.recorded.go_on_from(session.simulation->time());
  if (const EffectSet effects = changes(before, session.preset()); !effects.empty()) {
    follow_up(session, before, effects);
    if (!effects.within(beside_model)) session.rewind.note_change();
  }
}

/// Why a file from anybody is not repeated in the window, where each of its steps can be gone to at once; empty: it is.
std::string refusal(const Experiment& experiment) {
  constexpr double most_particles = 1e6;  // that are built within a frame
  const Preset& start = experiment.recording.start();
  if (particles(experiment.largest) > std::max(most_particles, particles(start)))
    return "it changes to a cloth of " + grouped(std::int64_t(particles(experiment.largest))) + " particles";
  // A device's programs are first tried in a process of their own, for the constants with which a cloth is opened.
  Preset now = start;
  for (const Recording::Entry& entry : experiment.recording.events()) {
    const auto* change = std::get_if<event::Change>(entry.event);
    const auto* resume = std::get_if<event::Resume>(entry.event);
    if (change != nullptr || resume != nullptr)
      now = with_settings(now, change != nullptr ? change->settings : resume->settings);
    if (now.engine == EngineKind::opencl && start.engine != EngineKind::opencl) return "it changes to an OpenCL device";
  }
  return "";
}

/// Of a recording that has come to its end.
void finish(Session& session) {
  const Repetition over = *std::move(session.repetition);
  session.repetition.reset();
  if (over.experiment == nullptr) return;  // its motion goes on
  session.pacing.playing = false;
  session.document.saved = session.preset();  // which the file has
  session.messages.note("The end of the experiment " + title(session) + ": " +
                        comparison_in_words(over.playback, *over.experiment) +
                        " The motion is paused; Space continues it.");
}

}  // namespace

void begin_repetition(Session& session, std::shared_ptr<const Experiment> experiment) {
  assert(experiment != nullptr);
  if (const std::string why = refusal(*experiment); !why.empty())
    return session.messages.error("The experiment " + title(session) + " is not repeated here, since " + why +
                                  ". `tyglab run` repeats it.");
  session.repetition = Repetition{experiment, Playback(experiment->recording)};
  session.repetition->playback.begin(*session.simulation);
  session.messages.note("Repeats the experiment " + title(session) + ", " +
                        time_number(experiment->seconds, session.preset().dt) +
                        " s. It ends where you change or touch something.");
}

bool make_recorded_events(Session& session) {
  assert(session.repetition && !session.background_steps.busy());
  const auto fail = [&](const std::string& why) {
    session.messages.error("The recording cannot be repeated further: " + why);
    session.timeline.leave(session.repetition->playback.recording(), session.simulation->past().steps());
    session.repetition.reset();
    return false;
  };
  try {
    while (session.repetition->playback.due(*session.simulation) != nullptr) make_event(session);
  } catch (const std::bad_alloc&) {
    return fail("there is not enough memory.");
  } catch (const std::exception& error) {
    return fail(error.what());
  }
  if (session.repetition->playback.over(*session.simulation)) {
    finish(session);
    return session.pacing.playing;
  }
  if (session.simulation->divergence()) return fail("the motion has diverged where the recorded one did not.");
  return true;
}

int up_to_next_event(const Session& session, int steps) {
  if (!session.repetition) return steps;
  return int(std::min<std::int64_t>(steps, session.repetition->playback.steps_to_next(*session.simulation)));
}

void leave_repetition(Session& session) {
  if (!session.repetition) return;
  const Repetition left = *std::move(session.repetition);
  session.repetition.reset();
  session.timeline.leave(left.playback.recording(), session.simulation->past().steps());
  const bool kept = left.playback.recording().steps() - session.simulation->past().steps() >= Timeline::shortest_branch;
  if (left.experiment == nullptr && !kept) return;
  if (left.experiment == nullptr)
    session.messages.note(
        "From here the motion takes another course. The former one is kept: its mark on the timeline "
        "leads back to it.");
  else
    session.messages.note("You have taken over the experiment " + title(session) +
                          " at t = " + time_number(clock_time(session), session.preset().dt) + " s.");
}

std::string repetition_in_words(const Session& session) {
  if (!session.repetition) return "";
  if (session.repetition->experiment == nullptr)
    return "repeating to step " + grouped(session.repetition->playback.recording().steps());
  return "repeating " + title(session) + " to step " + grouped(session.repetition->playback.recording().steps());
}

}  // namespace tyglab
