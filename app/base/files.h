// Files of data, presets, and names of files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/preset.h"

// The locations of the program's own files: presets, labs, shaders, textures.

namespace tyglab {

/// A file that belongs to the program is missing. `what()` names it and what to do.
class DataFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The folder with presets/, labs/, shaders/ and textures/: the one that was set, or else ../share/tyglab beside the
/// folder of the executable, in the build tree as after `cmake --install`.
const std::filesystem::path& data_folder();
/// Sets that folder in a program other than Tyglab, such as a Python interpreter. To be called before anything uses the
/// folder.
void set_data_folder(const std::filesystem::path& folder);

/// A file (or folder) of the program, as "shaders/cloth.vert". Throws DataFileError if it is missing.
std::filesystem::path data_file(std::string_view name);

/// Whether there is a shipped texture of that name.
bool is_shipped_texture(const std::string& name);
/// The file of a texture, given by a shipped name or a path. It need not exist.
std::filesystem::path texture_file(const std::string& name);

// Makes file names from names that people choose.

/// A name in lower-case letters of ASCII and digits, with _ for all between: "Övning å, 2" is "ovning_a_2". Accents and
/// other marks of letters are left out. Empty where nothing remains.
std::string plain_file_name(std::string_view name);

// Detects whether a file has changed since it was read.

/// Identifies the content of a file: equal stamps mean equal content, unless the file was written twice between two
/// ticks of the clock, or its time was set back.
struct FileStamp {
  std::filesystem::path file;
  std::filesystem::file_time_type written;
  std::uintmax_t bytes;

  bool operator==(const FileStamp&) const = default;
};

/// None if there is no such file.
std::optional<FileStamp> stamp_of(const std::filesystem::path& file);

// Preset files: the shipped ones and the user's own.

/// The names of the shipped presets, sorted.
std::vector<std::string> shipped_presets();

/// Where a preset comes from.
struct PresetSource {
  std::filesystem::path file;
  std::string label;  ///< the shipped name, or the file's name without its extension, after which outputs are named
};
/// Finds a shipped preset by its name, or else a file. Throws PresetError, which suggests the nearest name, or one of
/// `commands`.
PresetSource find_preset(const std::string& name_or_file, const std::vector<std::string>& commands = {});
/// Whether there is a shipped preset or a file of that name.
bool is_preset(const std::string& name_or_file);

/// Reads a preset to be shown, or that with which an experiment begins (experiment_file.h): its texture is a shipped
/// name, or the path of an image in the preset's folder. Throws PresetError (load_preset).
Preset read_preset(const std::filesystem::path& file);
/// A texture that the user chose, in the form of a preset: a shipped name, or the absolute path of any image.
std::string chosen_texture(const std::string& name_or_file);
/// Writes a preset whose texture may have been chosen anywhere: an image from elsewhere is copied beside the file,
/// since a preset names none outside its folder. Returns the preset as read_preset() reads it. Throws OutputError,
/// which leaves the older preset in place.
Preset write_preset(Preset preset, const std::filesystem::path& file);

}  // namespace tyglab
