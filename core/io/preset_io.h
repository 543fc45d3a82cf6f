// Reads and writes presets: JSON files, `--set KEY=VALUE`. Everything is checked before anything is applied.
#pragma once

#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/preset.h"

namespace tyglab {

struct JsonNode;

/// A preset (or a --set) is wrong. `what()` names file, line, key and the allowed values.
class PresetError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr int preset_version = 1;

/// Parses and checks a whole preset. `source` names it in errors. `folder`: the folder of the preset's file, outside
/// which it may name no texture (texture_problem()). Throws PresetError; never returns a partial preset.
Preset parse_preset(std::string_view text, std::string_view source, const std::filesystem::path& folder = {});
/// The same of a part of a larger JSON file; `at` is the path of its keys there ("session.preset").
Preset preset_from(const JsonNode& root, std::string_view source, const std::filesystem::path& folder = {},
                   std::string_view at = {});
/// Reads a file. Throws PresetError (missing, unreadable, wrong).
Preset load_preset(const std::filesystem::path& file);
/// Why a preset in that folder may not name this texture, so that a stranger's preset opens no other file; empty if the
/// texture is a plain name, or lies in the folder or below it and no link leads out. It need not exist.
std::string texture_problem(const std::string& texture, const std::filesystem::path& folder);
/// JSON text with every key, one block a line, ready to be read and edited by a person.
std::string preset_to_json(const Preset& preset);
/// Writes atomically: a temporary file beside it, then renamed. Throws OutputError.
void save_preset(const Preset& preset, const std::filesystem::path& file);
/// 64-bit FNV-1a of the JSON text without name, description, view and texture, in hex: tells scenes apart in state
/// files.
std::string preset_hash(const Preset& preset);

/// The same for settings as --set takes them: k_s=500, "W=[0,0,0.02]", "bodies[0].r=0.3".
Preset with_settings(const Preset& preset, const std::vector<std::string>& settings);

/// The differences between two presets as such settings, except for the descriptions: with_settings(from, these) is
/// `to`.
std::vector<std::string> settings_between(const Preset& from, const Preset& to);

/// A setting, and its name in errors as it was typed.
struct Setting {
  std::string typed;  ///< "--set k_s=500", "--dt 0.001"
  std::string key, value;
};
/// Splits "KEY=VALUE". Throws PresetError.
Setting parse_setting(const std::string& text);
/// Applies settings to a copy, in order, checks the whole, and returns it. Throws PresetError naming the setting.
Preset with_parsed_settings(const Preset& preset, const std::vector<Setting>& settings);

/// The first error of this preset (as edited in a program), or empty. The checks are those for files.
std::string check_preset(const Preset& preset);

// Reads files that a person may supply: never more than a size limit, and without blocking.

/// A file cannot be read. `what()` names it and says why.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The bytes of a file; `kind` ("preset") is what it should be, of `most_bytes` at most. Throws InputError, also where
/// the name belongs to a folder, a pipe or a device.
std::string read_input(const std::filesystem::path& file, const std::string& kind, std::uintmax_t most_bytes);

}  // namespace tyglab
