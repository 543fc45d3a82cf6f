// Parts that an engine is compiled with. The engine that scenes run on has all; `tyglab bench skip` also runs engines
// compiled without one, to show that a part costs nothing while it is off.
#pragma once

#include <memory>

#include "core/cloth/lattice.h"
#include "core/engines/cpu/pair_sweep.h"
#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab::cpu {

/// Parts of an engine, one bit each; the first three equal the sweep's features.
namespace part {
enum : unsigned {
  bending = cpu::bending,
  damping = cpu::damping,
  wind = cpu::wind,
  bodies = 8,
  tearing = 16,
  pins = 32,  ///< pinned and held particles keep their velocity
  hand = 64,  ///< the force on the held particle is measured, and the hand lets go above F_release
  everything = 127
};
}  // namespace part

/// An engine in float, on one thread, compiled without that part: for measurements only. It treats the preset as if the
/// part were off. Null if `absent` is not exactly one part. Throws EngineError in a build with sanitizers, which leaves
/// these engines out, since no scene runs on them and each takes four times as long to compile.
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
#define TYGLAB_FOR_EACH_PART(MAKE)               \
  MAKE(float, part::everything & ~part::bending) \
  MAKE(float, part::everything & ~part::damping) \
  MAKE(float, part::everything & ~part::wind)    \
  MAKE(float, part::everything & ~part::bodies)  \
  MAKE(float, part::everything & ~part::tearing) \
  MAKE(float, part::everything & ~part::pins)    \
  MAKE(float, part::everything & ~part::hand)
#endif
