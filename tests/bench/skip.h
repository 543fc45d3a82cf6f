// `tyglab bench skip` measures the cost of a feature that is on, off, and absent from the compiled engine.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/cloth/state.h"
#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

/// How a feature is run.
enum class SkipState { on, off, absent };
std::string_view name_of(SkipState);

struct SkipFeature {
  std::string name;           ///< "bending"
  std::string on_means;       ///< what is measured as "on", for people
  unsigned absent = 0;        ///< parts that the engine without it lacks (core/engines/cpu/parts.h); 0: none, it is the
                              ///< sweep's, and the engine without it is that with it off
  Preset preset_on;           ///< the scene with it
  Preset preset_off;          ///< the same scene without it
  bool held_when_on = false;  ///< a particle in the middle is held
};

/// The features, with scenes of `side` x `side` particles in float.
std::vector<SkipFeature> skip_features(int side);

/// One engine ready to step: a feature in a state.
class SkipCase {
 public:
  /// Makes the first step, which costs more than others. Where `state` is absent, the preset's precision must be float.
  SkipCase(const SkipFeature& feature, SkipState state);
  /// Makes the steps (instructions_posix.cpp counts inside this function); returns nanoseconds per particle and
  /// step. Throws std::runtime_error if the scene diverges or tears.
  double advance(int steps);
  std::string engine_name() const { return engine_->name(); }

 private:
  int particles_;
  Tears tears_;
  std::unique_ptr<Engine> engine_;
};

struct SkipRow {
  SkipFeature feature;
  int rounds = 0;
  double ns_absent = 0;  ///< median
  double ns_off = 0;     ///< ns_absent times the median ratio of off to absent
  double ns_on = 0;      ///< likewise
};

/// Measures one feature in `rounds` rounds of short runs, each round in all three states one after another: what
/// disturbs the machine meets all of them, and ratios within a round hardly see it.
SkipRow measure_skip(const SkipFeature& feature, int rounds);

}  // namespace tyglab
