// Repeats an experiment (app/base/experiment_file.h) in the sandbox: makes what was done while it was recorded, until
// it is over or the user changes something. From there on the motion is the user's, and so is the recording.
#pragma once

#include <memory>
#include <string>

#include "core/output/experiment.h"
#include "core/playback.h"

namespace tyglab {

struct Session;

struct Repetition {
  std::shared_ptr<const Experiment> experiment;  ///< that was opened; null: of what was done here (timeline.h)
  Playback playback;
};

/// Begins to repeat an experiment; the session's cloth is at its start.
void begin_repetition(Session& session, std::shared_ptr<const Experiment> experiment);
/// Before a frame's steps, and between them: makes the events that are due. Whether there is more to repeat; says and
/// pauses where there is not.
bool make_recorded_events(Session& session);
/// Of that many steps those that can be made until the next event.
int up_to_next_event(const Session& session, int steps);
/// The user has changed something.
void leave_repetition(Session& session);
/// "repeating “waves” to step 12,345"; empty where nothing is repeated.
std::string repetition_in_words(const Session& session);

}  // namespace tyglab
