// The locations of the program's own files: presets, labs, shaders, textures.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace tyglab {

/// A file that belongs to the program is missing. `what()` names it and what to do.
class DataFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The folder with presets/, labs/, shaders/ and textures/: the one that was set, or else ../share/tyglab beside the
/// folder of the executable, in the build tree as after `cmake --install`.
const std::filesystem::path& data_folder();
/// Of a program that is not Tyglab's own, as a Python interpreter is: before anything asks for the folder.
void set_data_folder(const std::filesystem::path& folder);

/// A file (or folder) of the program, as "shaders/cloth.vert". Throws DataFileError if it is missing.
std::filesystem::path data_file(std::string_view name);

/// Whether there is a shipped texture of that name.
bool is_shipped_texture(const std::string& name);
/// The file of a texture: that of a shipped name, or else the path that it is. Need not exist.
std::filesystem::path texture_file(const std::string& name);

}  // namespace tyglab
