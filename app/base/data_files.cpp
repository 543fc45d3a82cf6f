#include "app/base/data_files.h"

#include <system_error>

#include "app/base/program.h"

namespace tyglab {
namespace fs = std::filesystem;

namespace {

fs::path& given_folder() {
  static fs::path folder;
  return folder;
}

}  // namespace

void set_data_folder(const fs::path& folder) {
  given_folder() = folder;
}

const fs::path& data_folder() {
  if (!given_folder().empty()) return given_folder();
  static const fs::path folder = [] {
    try {
      return data_folder_beside(program_file().parent_path());
    } catch (const fs::filesystem_error& error) {
      throw DataFileError(std::string("The folder of the program cannot be found (") + error.what() +
                          "). Is /proc mounted?");
    }
  }();
  return folder;
}

fs::path data_file(std::string_view name) {
  fs::path file = data_folder() / name;
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw DataFileError("The program's file " + file.string() +
                        " is missing. Rebuild (app/run), or reinstall with cmake --install.");
  }
  return file;
}

bool is_shipped_texture(const std::string& name) {
  const fs::path given(name);
  std::error_code error;
  return given.has_filename() && !given.has_parent_path() && fs::exists(data_folder() / "textures" / given, error);
}

fs::path texture_file(const std::string& name) {
  return is_shipped_texture(name) ? data_folder() / "textures" / name : fs::path(name);
}

}  // namespace tyglab
