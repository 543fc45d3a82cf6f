// Random presets and edits for `tyglab stability stress`.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "core/edit.h"
#include "core/model/preset.h"
#include "core/simulation.h"

namespace tyglab {

/// Seeded numbers that are the same with every library: of the standard's, only the generator is.
class StressRandom {
 public:
  StressRandom(std::uint64_t seed, std::uint64_t number);
  double uniform(double low, double high);
  /// Evenly over the decades between two positive numbers.
  double decades(double low, double high);
  /// In [0, n).
  int below(int n) { return int(bits_() % std::uint64_t(n)); }
  bool chance(double part) { return uniform(0, 1) < part; }

 private:
  std::mt19937_64 bits_;
};

/// `integrator`: of the preset; empty: any.
Preset random_preset(StressRandom& random, const std::string& integrator);
/// The preset with one constant, precision or, unless it is kept, the integrator changed, `what` being its key; valid.
Preset changed(const Preset& preset, StressRandom& random, bool keeps_integrator, std::string& what);
/// An edit that fits the simulation, `what` being its name.
Edit random_edit(const Simulation& simulation, StressRandom& random, bool keeps_integrator, std::string& what);

}  // namespace tyglab
