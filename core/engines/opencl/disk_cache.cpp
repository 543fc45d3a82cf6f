#include "core/engines/opencl/program_cache.h"

#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tyglab::opencl {
namespace {

namespace fs = std::filesystem;

std::uint64_t fnv1a(const std::string& text, std::uint64_t hash) {
  for (const unsigned char byte : text) hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}

/// Where a program of that key is kept; empty: nowhere.
fs::path file_of(const std::string& key) {
  const char *xdg = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
  fs::path folder;
  if (xdg != nullptr && *xdg == '/')
    folder = xdg;
  else if (home != nullptr && *home == '/')
    folder = fs::path(home) / ".cache";
  else
    return {};
  std::array<char, 48> name{};
  // Two seeds: 128 bits, so that two keys do not meet.
  std::snprintf(name.data(), name.size(), "%016llx%016llx.clbin",
                static_cast<unsigned long long>(fnv1a(key, 0xcbf29ce484222325u)),
                static_cast<unsigned long long>(fnv1a(key, 0x9e3779b97f4a7c15u)));
  return folder / "tyglab" / name.data();
}

}  // namespace

std::string cached_program(const std::string& key) {
  const fs::path file = file_of(key);
  if (file.empty()) return {};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!(text << in.rdbuf())) return {};
  return text.str();
}

void cache_program(const std::string& key, const std::string& binary) {
  const fs::path file = file_of(key);
  std::error_code error;
  if (file.empty() || (fs::create_directories(file.parent_path(), error), error)) return;
  const fs::path beside = file.string() + "." + std::to_string(::getpid());
  std::ofstream out(beside, std::ios::binary);
  out.write(binary.data(), std::streamsize(binary.size()));
  out.close();
  if (out) fs::rename(beside, file, error);
  if (!out || error) fs::remove(beside, error);
}

}  // namespace tyglab::opencl
