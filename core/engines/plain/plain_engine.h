// The plain cloth (plain_cloth.h) as an engine: `--engine plain`. In double whatever the preset's precision, on one
// thread, about 60 times slower than the CPU engine.
#pragma once

#include <memory>

#include "core/engines/engine.h"

namespace tyglab {

/// Throws EngineError for a method that is not written out (scheme.h).
std::unique_ptr<Engine> make_plain_engine(const Preset& preset, const Lattice& lattice);

}  // namespace tyglab
