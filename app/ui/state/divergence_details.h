// The description of a divergence, of the cloth itself or of a copy.
#pragma once

#include <string>

#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

/// When, where and what it was, and the constants `then` that decided it: they may be others by now. `limit`: the
/// largest dt that was stable in any shape, s; 0 or infinite: there is none.
std::string what_happened(const Divergence& divergence, const Preset& then, double limit);

}  // namespace tyglab
