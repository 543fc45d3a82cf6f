// The only place that changes the cloth and its copies in the sandbox: edits, and their consequences in the
// window.
#pragma once

#include <string>

#include "app/session/history.h"
#include "core/edit.h"

namespace tyglab {

struct Session;

/// Applies one edit at once, or beside the frames where it takes long. Edits of one gesture (a drag of a slider) are
/// undone together; 0 stands alone. Returns whether it was taken; what speaks against it becomes a message.
bool apply_edit(Session& session, const Edit& edit, unsigned gesture = 0);
/// Gives an edit to the cloth and its copies, with no more checks or traces than they make themselves. Throws as
/// Simulation::apply.
void apply_to_all(Session& session, const Edit& edit);
/// What stands now, to be brought back when an action is undone that changes the motion itself.
HistoryEntry motion_entry(Session& session, std::string what);
/// What follows where the cloth of these constants has given way to the present one.
void follow_up(Session& session, const Preset& before);

}  // namespace tyglab
