// The parts with which an engine is compiled. Scenes run on an engine with all parts; `tyglab bench skip` also runs
// engines without some of them, to show that a part costs nothing while it is off.
#pragma once

#include <memory>

#include "core/cloth/lattice.h"
#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab::cpu {

/// Parts of an engine, one bit each. Bending, damping and wind are none: they are arguments of the compiled sweep
/// (pair_sweep.h), so while they are off an engine runs the same machine code as one without them.
namespace part {
enum : unsigned {
  bodies = 1,
  tearing = 2,
  pins = 4,  ///< pinned and held particles keep their velocity
  hand = 8,  ///< the force on the held particle is measured, and the hand lets go above F_release
  all_but_pins = bodies | tearing | hand,
  everything = all_but_pins | pins
};
}  // namespace part

/// An engine in float, on one thread, compiled without those parts, pins or all but pins: for measurements only. It
/// treats the preset as if they were off. Null for other parts. Throws EngineError in a build with sanitizers, which
/// leaves these engines out, since no scene runs on them and each takes long to compile.
std::unique_ptr<Engine> make_engine_without(unsigned absent, const Preset& preset, const Lattice& lattice);

}  // namespace tyglab::cpu

/// MAKE(R, present) for every engine that is compiled.
#define TYGLAB_FOR_EACH_CPU_ENGINE(MAKE) \
  MAKE(float, part::everything)          \
  MAKE(double, part::everything)         \
  TYGLAB_FOR_EACH_PART(MAKE)
#ifdef TYGLAB_WHOLE_ENGINES
#define TYGLAB_FOR_EACH_PART(MAKE)
#else
#define TYGLAB_FOR_EACH_PART(MAKE) \
  MAKE(float, part::pins)          \
  MAKE(float, part::all_but_pins)
#endif
