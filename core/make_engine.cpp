#include "core/engines/engine.h"

#include "core/engines/cpu/cpu_engine.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/engines/plain/plain_cloth.h"

namespace tyglab {

std::string engine_problem(const Preset& preset) {
  if (preset.engine == EngineKind::opencl) return opencl_problem(preset);
  return preset.engine == EngineKind::plain ? plain_problem(preset) : "";
}

std::unique_ptr<Engine> make_engine(const Preset& preset, const Lattice& lattice, int threads) {
  if (preset.engine == EngineKind::opencl) return opencl::make_opencl_engine(preset, lattice);
  if (preset.engine == EngineKind::plain) return make_plain_engine(preset, lattice);
  return cpu::make_cpu_engine(preset, lattice, threads);
}

}  // namespace tyglab
