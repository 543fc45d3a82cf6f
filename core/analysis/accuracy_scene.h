// The scenes of `tyglab bench accuracy`, small and short enough to be predictable.
#pragma once

#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

struct AccuracyScene {
  std::string name;     ///< "hanging"
  std::string title;    ///< a few words for people
  Preset preset;        ///< integrator, dt and precision are the rows' own
  double seconds;       ///< until then positions are compared
  bool damped = false;  ///< so heavily that explicit methods need a dt far below what oscillations ask for
};

/// Times at which positions are compared: the end, and as many equal parts before it.
inline constexpr int accuracy_samples = 4;

/// A mass on a spring, then the cloths, the heavily damped ones last.
std::vector<AccuracyScene> accuracy_scenes();

}  // namespace tyglab
