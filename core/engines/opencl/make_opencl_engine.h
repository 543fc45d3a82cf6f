// Creates the OpenCL engine without an OpenCL header.
#pragma once

#include <memory>

#include "core/engines/engine.h"

namespace tyglab::opencl {

/// Throws EngineError where there is no such device, it cannot run the preset, or the program was built without OpenCL.
/// `width`: particles that a work-item works on at a time, 1, 4, 8 or 16; 0: what suits the device (tests try all).
std::unique_ptr<Engine> make_opencl_engine(const Preset& preset, const Lattice& lattice, int width = 0);

}  // namespace tyglab::opencl
