// The shortest part of a recording that still breaks something, by delta debugging (Zeller and Hildebrandt 2002).
#pragma once

#include <functional>
#include <vector>

#include "tests/monkey/action.h"

namespace tyglab::monkey {

/// `fails`: whether these actions, done from the start, break it. First the end of the recording is tried, twice as
/// long each time; then parts are left out, down to single actions. Ends early where `enough` says so.
std::vector<Action> shrunk(std::vector<Action> actions, const std::function<bool(const std::vector<Action>&)>& fails,
                           const std::function<bool()>& enough);

}  // namespace tyglab::monkey
