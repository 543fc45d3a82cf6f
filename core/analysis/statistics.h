// Means over time, and their accuracy, for a motion that cannot be predicted.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/analysis/reference.h"

namespace tyglab {

/// A mean over time and its standard error, from the means of blocks that are long beside what a motion remembers.
struct TimeMean {
  double mean = 0, error = 0;
};
TimeMean mean_of_blocks(std::span<const double> block_means);

/// How a method moves a scene in the long run.
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
