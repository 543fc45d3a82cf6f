// Gusts: W swells and falls with simulated time. No part of the report's model, in which the wind is steady, and off
// unless asked for. The forces stay a(x, v): the wind changes between two steps only, so that every stage of a step of
// every method feels the same one.
//
// Simulation::advance_part gives the engine another W between steps, so no engine, method or formula knows of gusts;
// where they are off they cost one comparison for each call of advance.
#pragma once

#include "core/model/preset.h"

namespace tyglab {

/// Whether the wind of these constants blows in gusts.
inline bool gusts(const Preset& preset) {
  return preset.gust > 0 && preset.W != glm::dvec3(0) && preset.kind == Kind::cloth;
}

/// The gusts at time t (s) in units of their strength, -1 to 1: a smooth sum of three sines whose periods, the longest
/// `period` (s), have no common multiple. Its mean is 0.
double gust_wave(double t, double period);

/// The wind over the next steps.
struct GustSpan {
  double factor = 1;  ///< by which W is multiplied
  int steps = 1;      ///< of dt for which that holds, one at least
};
/// At time t (s). The wave is taken in the middle of each 64th of a period, or of a step where dt is longer than that,
/// so that cloths of unlike dt feel the same gusts.
GustSpan gust_span(const Preset& preset, double t);

/// The constants with W as it blows at time t, s; unchanged where there are no gusts.
Preset in_gusts(Preset preset, double t);

}  // namespace tyglab
