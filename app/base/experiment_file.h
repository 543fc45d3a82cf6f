// Files of experiments, NAME.tyglab: their text (core/output/experiment.h), packed.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/io/output_file.h"
#include "core/output/experiment.h"

namespace tyglab {

/// Whether a file is called as one.
bool is_experiment(const std::filesystem::path& file);
/// Reads a file. Throws PresetError (missing, unreadable, damaged, too large, wrong).
Experiment load_experiment(const std::filesystem::path& file);
/// Writes one (write_output). Returns where it is. Throws OutputError, also if it were too large to be read.
std::filesystem::path save_experiment(const Experiment& experiment, const std::filesystem::path& file,
                                      Reach reach = Reach::whole);
/// The bytes of such a file, and back. `source` names it in errors. Throws PresetError.
std::string experiment_bytes(const Experiment& experiment);
Experiment experiment_from(std::string_view bytes, std::string_view source);

}  // namespace tyglab
