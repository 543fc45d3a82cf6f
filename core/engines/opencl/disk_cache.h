// Caches slow results about a device (built programs, measured times) on disk between runs: in XDG_CACHE_HOME/tyglab,
// or ~/.cache/tyglab. A file that cannot be read or written counts as missing.
#pragma once

#include <filesystem>
#include <string>

namespace tyglab::opencl {

/// That folder, which need not exist; empty: there is none.
std::filesystem::path cache_folder();
/// What was kept under that key, which contains everything that it depends on (device, driver, options, text); empty if
/// there is nothing.
std::string kept_on_disk(const std::string& key);
void keep_on_disk(const std::string& key, const std::string& content);

}  // namespace tyglab::opencl
