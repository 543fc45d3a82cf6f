// What studies share: runs side by side, medians, the time of the last event, and cancelling.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/analysis/error_study.h"
#include "core/analysis/reference.h"

namespace tyglab {

/// The simulation with those settings at the start of the study, on the CPU engine: the only one that has every method,
/// and whose time is this thread's.
std::unique_ptr<Simulation> begin_study(const StudyStart& start, const Preset& preset);
/// Makes `steps` steps; fewer where the run diverges. Throws Stopped.
void advance_study(Simulation& simulation, int steps, const Stop& stop);
/// Particles times force evaluations of a step; what an implicit method needs is not known before.
double step_effort(const Preset& preset);
/// A dt of which `steps` make a part of the study (one of accuracy_samples), the largest that is at most `dt`, s.
double whole_dt(double seconds, double dt, int& steps);

// Runs independent measurements on several threads and reports the results in order.

/// Calls work(n) for every n in [0, count), on `threads` threads at a time, until stop() holds; calls finished(n) once
/// n and all before it are done, for one n after the other. Work that has begun is finished. Rethrows the first
/// exception of work or finished.
void in_parallel(int count, int threads, const std::function<void(int)>& work, const std::function<void(int)>& finished,
                 const std::function<bool()>& stop);

// Finds the time of the last event that is new in a motion, and that a shorter trial would therefore miss.

/// Time from the start, s, of the last new event within `seconds`: a contact, a tear, or springs that pull a particle
/// more than twice as hard as ever before (a slack cloth becomes taut). In a motion that touches a body, tears or
/// diverges new events can always follow, and the result is `seconds`. It makes one run with a coarse step. Throws
/// Stopped.
double time_of_last_event(const StudyStart& start, double seconds, const Stop& stop);
/// The hardest impact of a body within `seconds`: the largest sudden change of a particle's velocity, m/s; 0 without
/// contact. It makes a run of this kind too. Throws Stopped.
double hardest_blow(const StudyStart& start, double seconds, const Stop& stop);
/// Effort of such a run: particles times force evaluations.
double last_event_effort(const Preset& preset, double seconds);

// Means over time, and their accuracy, for a motion that cannot be predicted.

/// A mean over time and its standard error, from the means of blocks that are long beside what a motion remembers.
struct TimeMean {
  double mean = 0, error = 0;
};
TimeMean mean_of_blocks(std::span<const double> block_means);

/// Statistics of a method on a scene in the long run.
struct MotionStatistics {
  std::string scene, integrator;
  double dt = 0;            ///< s
  double from = 0, to = 0;  ///< s, of the time over which the means are taken
  TimeMean height{};        ///< of all particles, m
  TimeMean kinetic{};       ///< energy of all particles, J
  double change = 0;        ///< of the total energy from the start to the end, in parts of the kinetic mean
  bool diverged = false;
};

/// Every integrator on one scene in double: explicit ones with half of Verlet's limit as dt, implicit ones and xpbd
/// with three times that; as many at a time as there are threads. `quick`: a quarter of the time. What has been
/// measured when `stop` says so is kept; it is asked by all threads.
std::vector<MotionStatistics> measure_statistics(const AccuracyScene& scene, bool quick, int threads, const Stop& stop);

}  // namespace tyglab
