#include "app/base/data_files.h"

#include <system_error>

namespace tyglab {
namespace fs = std::filesystem;

const fs::path& data_folder() {
  static const fs::path folder = [] {
    std::error_code error;
    const fs::path executable = fs::read_symlink("/proc/self/exe", error);
    if (error) {
      throw DataFileError("The folder of the program cannot be found (/proc/self/exe: " + error.message() +
                          "). Is /proc mounted?");
    }
    return (executable.parent_path() / ".." / "share" / "tyglab").lexically_normal();
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

fs::path texture_file(const std::string& name) {
  const fs::path given(name);
  if (given.has_filename() && !given.has_parent_path()) {
    const fs::path shipped = data_folder() / "textures" / given;
    std::error_code error;
    if (fs::exists(shipped, error)) return shipped;
  }
  return given;
}

}  // namespace tyglab
