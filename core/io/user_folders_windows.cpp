#include "core/io/user_folders.h"

#include <cstdlib>

namespace tyglab {

std::string environment(const char* name) {
  const wchar_t* value = ::_wgetenv(std::filesystem::path(name).c_str());
  return value != nullptr ? std::filesystem::path(value).string() : std::string();
}

std::filesystem::path settings_base() {
  return environment("APPDATA");
}

std::filesystem::path cache_base() {
  return environment("LOCALAPPDATA");
}

std::filesystem::path home_folder() {
  return environment("USERPROFILE");
}

}  // namespace tyglab
