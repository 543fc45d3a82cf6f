// Replays the last steps before a divergence slowly; at full speed an explosion lasts only a few frames.
#pragma once

#include <cstdint>
#include <string>

#include "core/engines/engine.h"

namespace tyglab {

struct Session;

struct Replay {
  static constexpr int steps = 50;
  static constexpr double lasts = 6;  ///< s, about

  Divergence of;            ///< what it leads to
  std::int64_t first = 0;   ///< the step with which it begins
  std::int64_t at = 0;      ///< the step to which it has come
  double speed = 0;         ///< of the replay
  double former_speed = 0;  ///< to go on with afterwards
};

/// Why there is nothing to replay, a sentence; empty: there is.
std::string nothing_to_replay(const Session& session);
/// Goes back to shortly before the divergence, and on from there slowly. What was asked for meanwhile stays.
void begin_replay(Session& session);
/// Ends it where it has come to its divergence, passed it, or been left by a restart. Called after the steps of a
/// frame.
void watch_replay(Session& session);

}  // namespace tyglab
