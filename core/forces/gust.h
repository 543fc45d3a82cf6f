// Gusts: W varies with simulated time. They are not part of the report's model, whose wind is steady, and off by
// default. The acceleration remains a(x, v): the wind changes only between two steps, so all stages of a step use one
// wind.
//
// Simulation::advance_part gives the engine another W between steps, so engines, methods and formulas need no code for
// gusts. If gusts are off, they cost one comparison for each call of advance.
#pragma once

#include "core/model/preset.h"

namespace tyglab {

/// Whether the wind of this preset varies.
inline bool gusts(const Preset& preset) {
  return preset.gust > 0 && preset.W != glm::dvec3(0) && preset.kind == Kind::cloth;
}

/// The gusts at time t (s) relative to their strength, -1 to 1: a sum of three sines whose periods, the longest of
/// which is `period` (s), have no common multiple. The mean is 0.
double gust_wave(double t, double period);

/// The wind over the next steps.
struct GustSpan {
  double factor = 1;  ///< of W
  int steps = 1;      ///< of dt for which the factor holds, at least 1
};
/// At time t (s). The wave is sampled in the middle of each 64th of a period, or of a step if dt is longer than that,
/// so that cloths of different dt have the same gusts. A step over the border of two such spans gets the mean of the
/// wind over the step.
GustSpan gust_span(const Preset& preset, double t);

/// The preset with W as it is at time t (s); unchanged if there are no gusts.
Preset in_gusts(Preset preset, double t);

}  // namespace tyglab
