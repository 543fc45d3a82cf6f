// `tyglab bench throughput`: time for one particle and step, beside what this machine could reach at most.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

struct ThroughputCase {
  std::string variant;  ///< what differs from the plain scene, empty if nothing
  Preset preset;
  int threads = 1;
};

struct ThroughputRow {
  ThroughputCase of;
  double ns_per_particle_step = 0;  ///< median
  double ns_lowest = 0, ns_highest = 0;
  int repeats = 0;
  int threads_used = 1;                        ///< of an OpenCL device: its compute units
  std::string device;                          ///< what an OpenCL row ran on
  double register_limit_ns = 0;                ///< arithmetic alone, divided by the threads; 0: not this processor's
  double memory_limit_ns = 0;                  ///< moving the state once through memory (or the cache that holds it)
  std::vector<std::string> features, skipped;  ///< what the steps did, and what this scene has no need of
  double bytes_per_particle = 0;               ///< of all the solver's arrays
};

/// Steps a cloth for half a second: a processor that was idle takes a while to reach its speed.
void wake_processor();

/// The cases, smallest first, then those on an OpenCL device if there is one. `quick`: fewer sizes.
std::vector<ThroughputCase> throughput_cases(bool quick, int threads);

/// Measures one case: a warm-up, then `repeats` runs of some 10 ms, and of 16 steps at least. The preset must not
/// diverge.
ThroughputRow measure_throughput(const ThroughputCase& which, int repeats);

}  // namespace tyglab
