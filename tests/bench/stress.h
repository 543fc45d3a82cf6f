// `tyglab stability stress` runs random scenes over the range of every constant and edits them as they move. Each must
// stay bounded or be reported as diverged with time, particle, cause and advice, with finite values only. This file
// checks states, read-outs, forces and energies; tests/fuzz/runs checks the files that such runs write.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/engines/engine.h"
#include "core/model/preset.h"

namespace tyglab {

enum class StressStatus {
  bounded,
  diverged,  ///< and said so as it should
  failed     ///< a violation: `problem` says which
};
std::string_view name_of(StressStatus);

struct StressResult {
  Preset preset;  ///< it began with
  int threads = 1;
  std::int64_t steps = 0;          ///< made, all edits' restarts included
  std::vector<std::string> edits;  ///< "step 12: k_s"
  StressStatus status = StressStatus::bounded;
  std::optional<Divergence> divergence;
  std::int64_t unconverged = 0;  ///< solves
  std::string problem;
};

/// The scene of case `number` of a seed, which depends on nothing else. `integrator`: its method, which no edit changes
/// then; empty: any.
Preset stress_preset(std::uint64_t seed, std::uint64_t number, const std::string& integrator = "");
/// Runs that case to its end: that many steps that all take about the same time, fewer than 4,000.
StressResult run_stress(std::uint64_t seed, std::uint64_t number, const std::string& integrator = "");

}  // namespace tyglab
