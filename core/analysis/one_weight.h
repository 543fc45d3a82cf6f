// The mass on a spring of figure 3.2: its exact motion, and the error of an integrator.
#pragma once

#include <functional>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

/// Height (m) and velocity (m/s) along y.
struct WeightMotion {
  double y = 0, v = 0;
};

/// The exact motion of m y'' = -k (y - x_0.y) - k_d y' - m g from the preset's start at time t (s), t >= 0: damped,
/// undamped, overdamped, or without a spring.
WeightMotion exact_weight(const Preset& preset, double t);

/// A run of a mass on a spring beside the exact motion, a value a step and one for the start.
struct WeightRun {
  Preset preset;
  std::vector<double> t = {}, y = {}, exact = {};  ///< s, m, m
  double error_rms_m = 0;                          ///< of y over all steps
  double error_largest_m = 0;
  bool diverged = false;  ///< and ended there
};

/// Runs the preset, which must be a mass on a spring, for that many steps; `stop` is asked now and then, and ends it.
WeightRun run_weight(const Preset& preset, int steps, const std::function<bool()>& stop);

}  // namespace tyglab
