// Presets as files: those that are shipped, and those that a person names.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tyglab {

/// The names of the shipped presets, sorted.
std::vector<std::string> shipped_presets();

/// Where a preset comes from.
struct PresetSource {
  std::filesystem::path file;
  std::string label;  ///< the shipped name, or the file's name without its extension: what outputs are called after
};
/// A shipped name, or else a file. Throws PresetError; an unknown name is answered with the nearest, one of `commands`
/// if the word might have been meant for one.
PresetSource find_preset(const std::string& name_or_file, const std::vector<std::string>& commands = {});
/// Whether there is a shipped preset or a file of that name.
bool is_preset(const std::string& name_or_file);

}  // namespace tyglab
