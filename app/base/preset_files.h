// Preset files: the shipped ones and the user's own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/model/preset.h"

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

/// Reads a preset to be shown: its texture is a shipped name, or the path of an image in the preset's folder. Throws
/// PresetError (load_preset).
Preset read_preset(const std::filesystem::path& file);
/// A texture that the user chose, as a preset holds it: a shipped name, or the absolute path of an image anywhere.
std::string chosen_texture(const std::string& name_or_file);
/// Writes a preset whose texture may have been chosen anywhere: an image from elsewhere is copied beside the file,
/// since a preset names none outside its folder. Returns it as read_preset() reads it. Throws OutputError, and then the
/// older preset is still there.
Preset write_preset(Preset preset, const std::filesystem::path& file);

}  // namespace tyglab
