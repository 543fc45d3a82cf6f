// Commands for the motion and for all constants: restart, rewind, undo, single steps, an automatic dt.
#pragma once

#include <optional>
#include <string>

#include "app/session/session.h"

namespace tyglab {

/// Restarts with the present constants.
void restart(Session& session);
/// Goes back one second; the plots discard later samples, and the history discards later actions that changed the
/// motion. False if no earlier state is stored.
bool rewind(Session& session);
/// Goes back to a snapshot of the cloth (Rewind::before).
void go_back(Session& session, const Snapshot& then);
/// As rewind(), with a message about constants that were changed after that moment and stay.
bool rewind_and_say_what_stays(Session& session);
/// Restores earlier constants. An automatic dt stays automatic only if it would be chosen for them.
bool take_back(Session& session, const Preset& preset);
/// Undoes or redoes the last action of any kind, and names it.
void take_from_history(Session& session, bool backwards);
/// Restores the preset as it was opened: its constants and its start.
void reset_everything(Session& session);
/// Pauses, and makes one step of dt, in which the hand moves to that place.
void single_step(Session& session, const std::optional<glm::dvec3>& hand);
/// Makes dt automatic, or manual again.
void toggle_auto_dt(Session& session);
/// While dt is automatic: halves it if the ledger finds that the method adds energy.
void watch_dt(Session& session);
/// Moves the hand to that place over the next `steps` steps.
void move_hand(Session& session, const std::optional<glm::dvec3>& hand, int steps);

/// The time on clocks, s: the end of the last step or, after a divergence, of the step that diverged, as in messages
/// about it.
double clock_time(const Session& session);

/// For screen readers: the scene, the method, the lab's step, and whether the motion runs, which change seldom.
std::string state_in_words(const Session& session);
/// "3 springs torn or cut", "3 particles parted".
std::string tears_in_words(const Tears& tears);
std::string time_in_words(const Session& session);

}  // namespace tyglab
