// Clocks for measuring steps.
#pragma once

#include "core/model/preset.h"

namespace tyglab {

/// Processor time of this thread so far, s: what another process takes meanwhile is not in it. Where no clock measures
/// it, as in a browser, time on the wall stands for it.
double thread_seconds();

/// A clock on the wall, s: a device's work is not this thread's.
double wall_seconds();

/// The one that measures an engine's steps: of the processor on the CPU, on the wall on a device.
double computing_seconds(EngineKind engine);

}  // namespace tyglab
