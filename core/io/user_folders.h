// The user's folders, and the environment variables that set them.
#pragma once

#include <filesystem>
#include <string>

namespace tyglab {

/// A variable of the environment, in UTF-8; empty if it is not there.
std::string environment(const char* name);

/// Where programs keep their settings: XDG_CONFIG_HOME or ~/.config; on Windows %APPDATA%. Empty: nowhere.
std::filesystem::path settings_base();
/// Where programs keep what can be made again: XDG_CACHE_HOME or ~/.cache; on Windows %LOCALAPPDATA%. Empty: nowhere.
std::filesystem::path cache_base();
/// HOME; on Windows %USERPROFILE%. Empty if it is not known.
std::filesystem::path home_folder();

}  // namespace tyglab
