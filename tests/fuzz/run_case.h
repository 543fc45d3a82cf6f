// Whole runs that are valid and extreme: every constant at the ends of its range, sizes that are tiny or odd, all
// methods, precisions and engines, and what `tyglab run` is to write of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/preset.h"
#include "tests/support/scenes.h"

namespace tyglab::fuzz {

struct RunCase {
  Preset preset;
  int steps = 1;
  int threads = 1;
  std::vector<std::string> outputs;       ///< "values", "series", "ledger", "pc2", "obj": beside state and json
  std::optional<double> interrupt_after;  ///< s, after which it gets SIGINT
  bool twin = false;                      ///< run again with other threads and no outputs, to the same bytes

  bool operator==(const RunCase&) const = default;
};

/// Case `number` of a seed: the same on every machine.
RunCase run_case(std::uint64_t seed, std::int64_t number, bool with_opencl);

/// The case with one thing less that is unusual, for each such thing: constants at their defaults, no pins, a body or
/// an output fewer. What is not valid is left out.
std::vector<RunCase> simpler_cases(const RunCase& of);

/// Arguments of tyglab for the case: of `preset.json`, into files in the present folder.
std::vector<std::string> arguments_of(const RunCase& one);

/// Seconds that the steps take at most, as far as their cost is bounded: for limits, not for measurements.
double most_seconds(const RunCase& one);
/// Bytes of memory that a run takes at most beyond one of a single particle.
double most_bytes(const RunCase& one);

}  // namespace tyglab::fuzz
