// The features of a preset that determine which kernels an engine builds.
#pragma once

#include <string>

#include "core/model/preset.h"

namespace tyglab::opencl {

/// Whether bodies act on what the preset simulates.
inline bool meets_bodies(const Preset& preset) {
  return !preset.bodies.empty() && preset.kind == Kind::cloth;
}

/// Build options, " -D DAMPING" and so on. `contacts`: of steps that note what bodies stop.
std::string program_features(const Preset& preset, bool contacts);

}  // namespace tyglab::opencl
