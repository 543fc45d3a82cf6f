// `--engine auto` chooses the engine that steps a scene fastest on this machine, from short runs.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

/// What an engine takes for a scene.
struct EngineTime {
  EngineKind engine = EngineKind::cpu;
  int device = -1;    ///< number of an OpenCL device
  std::string name;   ///< for people
  double ns = 0;      ///< for a particle and step; 0: it cannot run the scene
  std::string fault;  ///< why not
};

struct EngineChoice {
  EngineKind engine = EngineKind::cpu;
  int device = -1;
  std::vector<EngineTime> times;  ///< of all that could have been chosen; empty where there was nothing to measure
  bool measured = false;          ///< just now, and not on an earlier day
  std::string why;                ///< a sentence
};

/// Measures the CPU engine with that many threads and every OpenCL device on the preset's cloth (of at most 1024 x 1024
/// particles), a few hundredths of a second each, three times in turn. Times are kept on disk, by device, driver,
/// threads, method, precision, features and size to a power of two, and read from there the next time. Where two are
/// within 5 % the CPU engine is taken, which waits for no compiler.
EngineChoice choose_engine(const Preset& preset, int threads);

/// The sentence for such times; the first is the CPU engine's.
EngineChoice choose_among(std::vector<EngineTime> times, bool measured);

}  // namespace tyglab
