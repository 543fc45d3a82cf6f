// Commands for the motion and for all constants: restart, rewind, undo, single steps, an automatic dt.
#pragma once

#include <optional>
#include <string>

#include "app/session/session.h"

namespace tyglab {

/// Back to the start with the present constants.
void restart(Session& session);
/// A second back; the plots forget what has not happened, and so does the history of the actions since then that
/// changed the motion. False where there is nothing to go back to.
bool rewind(Session& session);
/// Back by that much simulated time, s, or as far as states are kept; there must be one (Rewind::before).
void go_back(Session& session, const Snapshot& then);
/// The same, and says which constants stay though they were changed later than the moment that is back.
bool rewind_and_say_what_stays(Session& session);
/// Takes constants that stood before. An automatic dt stays so only if it is the one that would be chosen for them.
bool take_back(Session& session, const Preset& preset);
/// Undoes or redoes the last action, whatever it was, and says which.
void take_from_history(Session& session, bool backwards);
/// The preset as it was opened: its constants, its start.
void reset_everything(Session& session);
/// Pauses, and makes one step of dt; the hand that holds the cloth goes there.
void single_step(Session& session, const std::optional<glm::dvec3>& hand);
/// dt chosen and watched by the program, or set by hand again.
void toggle_auto_dt(Session& session);
/// While dt is automatic: halves it if the ledger finds that the method makes energy.
void watch_dt(Session& session);
/// Sends the hand that holds the cloth there over the next `steps` steps.
void move_hand(Session& session, const std::optional<glm::dvec3>& hand, int steps);

/// What clocks show, s: the end of the last step or, after a divergence, of the step that diverged, which is also what
/// sentences about it say.
double clock_time(const Session& session);

/// For screen readers: the scene, the method, the lab's step, and whether the motion runs, which change seldom.
std::string state_in_words(const Session& session);
std::string time_in_words(const Session& session);

}  // namespace tyglab
