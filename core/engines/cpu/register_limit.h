// The limit for throughput: the arithmetic of one step with all values in registers.
#pragma once

#include "core/model/preset.h"

namespace tyglab::cpu {

/// Nanoseconds for one particle's arithmetic of one step on one core of this machine, with the instruction set that the
/// sweep uses: four stretch springs with damping and two bending springs, each once and added to both its ends, gravity
/// and Verlet's update; no loads of particles, no stores. The best of `repeats` runs of a few milliseconds.
double register_limit_ns(Precision precision, int repeats);

}  // namespace tyglab::cpu
