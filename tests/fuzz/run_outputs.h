// What a run of `tyglab` has written, held against what it says of itself.
#pragma once

#include <filesystem>
#include <optional>

#include "tests/fuzz/run_check.h"

namespace tyglab::fuzz {

/// What is wrong with the exit code, the sentences and the files of a run in that folder.
std::optional<Finding> outputs_finding(const RunCase& one, int code, const std::filesystem::path& folder);

}  // namespace tyglab::fuzz
