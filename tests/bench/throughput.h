// `tyglab bench throughput` measures the time per particle and step, and the best time that this machine could reach.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

struct ThroughputCase {
  std::string variant;  ///< what differs from the plain scene, empty if nothing
  Preset preset;
  int threads = 1;
  int rows_cut = 0;  ///< across which the cloth is cut before it is measured
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
  int beside_load = 0;                         ///< threads that kept processors busy meanwhile
  double over_one_thread = 0;                  ///< median of the ratios to one thread's runs; 0: not compared
};

/// The limit for throughput: nanoseconds for one particle's arithmetic of one step on one core of this machine, with
/// the instruction set that the sweep uses: four stretch springs with damping and two bending springs, each once and
/// added to both its ends, gravity and Verlet's update; no loads of particles, no stores. The best of `repeats` runs of
/// a few milliseconds.
namespace cpu {
double register_limit_ns(Precision precision, int repeats);
}

/// Of one value at least.
double median(std::vector<double> values);

/// Steps a cloth for half a second: a processor that was idle takes a while to reach its speed.
void wake_processor();

/// The cases, smallest first, then those on an OpenCL device if there is one. `quick`: fewer sizes.
std::vector<ThroughputCase> throughput_cases(bool quick, int threads);

/// Measures one case: a warm-up, then `repeats` runs of some 10 ms, and of 16 steps at least. The preset must not
/// diverge.
ThroughputRow measure_throughput(const ThroughputCase& which, int repeats);

/// The cloths that are measured beside load, smallest first, with that many threads. `quick`: fewer sizes.
std::vector<ThroughputCase> cases_beside_load(bool quick, int threads);

/// Measures one thread, and then the case's threads, while `busy` other threads do nothing but keep processors busy: in
/// turn, `repeats` runs of some 30 ms each, longer than a scheduler's slices. The limits are not measured.
std::array<ThroughputRow, 2> measure_beside_load(const ThroughputCase& which, int busy, int repeats);

}  // namespace tyglab
