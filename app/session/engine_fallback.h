// Replaces the engine if its device is lost during the run.
#pragma once

#include <string>

#include "app/session/session.h"

namespace tyglab {

/// The device is gone, for that reason: the CPU engine goes on from the last state that is kept, or from the start
/// where none is, and a message says so. Throws EngineError where the CPU engine itself is at fault.
void fall_back(Session& session, const std::string& why);

}  // namespace tyglab
