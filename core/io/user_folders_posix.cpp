#include "core/io/user_folders.h"

#include <cstdlib>

namespace tyglab {

namespace {

/// What XDG's variable names, or that folder in the user's own.
std::filesystem::path base(const char* variable, const char* in_home) {
  if (const std::filesystem::path xdg = environment(variable); xdg.is_absolute()) return xdg;
  const std::filesystem::path home = home_folder();
  return home.empty() ? home : home / in_home;
}

}  // namespace

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::filesystem::path settings_base() {
  return base("XDG_CONFIG_HOME", ".config");
}

std::filesystem::path cache_base() {
  return base("XDG_CACHE_HOME", ".cache");
}

std::filesystem::path home_folder() {
  return environment("HOME");
}

}  // namespace tyglab
