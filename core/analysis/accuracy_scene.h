// The scenes of `tyglab bench accuracy`: small, and short enough to be predicted.
#pragma once

#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

struct AccuracyScene {
  std::string name;   ///< "hanging"
  std::string title;  ///< a few words for people
  Preset preset;      ///< integrator, dt and precision are the rows' own
  double seconds;     ///< until then positions are compared
};

/// Times at which positions are compared: the end, and as many equal parts before it.
inline constexpr int accuracy_samples = 4;

/// A mass on a spring, then the cloths.
std::vector<AccuracyScene> accuracy_scenes();

}  // namespace tyglab
