
#include "core/engines/opencl/program_text.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/forces/force.h"
#include "core/forces/linear_springs.h"
#include "core/io/output_file.h"
#include "core/io/system_files.h"

namespace tyglab::opencl {
namespace {

namespace fs = std::filesystem;

std::uint64_t fnv1a(const std::string& text, std::uint64_t hash) {
  for (const unsigned char byte : text) hash = (hash ^ byte) * 0x100000001b3u;
  return hash;
}

/// Where what has that key is kept; empty: nowhere.
fs::path file_of(const std::string& key) {
  const fs::path folder = cache_folder();
  if (folder.empty()) return {};
  std::array<char, 48> name{};
  // Two seeds: 128 bits, so that two keys do not meet.
  std::snprintf(name.data(), name.size(), "%016llx%016llx.bin",
                static_cast<unsigned long long>(fnv1a(key, 0xcbf29ce484222325u)),
                static_cast<unsigned long long>(fnv1a(key, 0x9e3779b97f4a7c15u)));
  return folder / name.data();
}

}  // namespace

fs::path cache_folder() {
  const fs::path base = cache_base();
  return base.is_absolute() ? base / "tyglab" : fs::path();
}

std::string kept_on_disk(const std::string& key) {
  const fs::path file = file_of(key);
  if (file.empty()) return {};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  if (!(text << in.rdbuf())) return {};
  return text.str();
}

void keep_on_disk(const std::string& key, const std::string& content) {
  const fs::path file = file_of(key);
  std::error_code error;
  if (file.empty() || (fs::create_directories(file.parent_path(), error), error)) return;
  try {
    write_atomically(file, content);
  } catch (const OutputError&) {  // then it is made again next time
  }
}

}  // namespace tyglab::opencl

namespace tyglab::opencl {

std::string program_features(const Preset& preset, bool contacts) {
  std::string text;
  if (force::damping.on(preset)) text += " -D DAMPING";
  if (meets_bodies(preset)) text += contacts ? " -D BODIES -D CONTACTS" : " -D BODIES";
  if (preset.kind == Kind::one_weight) return text + " -D ONE_WEIGHT";
  const bool linear = LinearSprings<float>::exist(preset);
  if (force::bend.on(preset) || linear) text += " -D BENDING";
  if (linear) text += " -D LINEAR";
  if (force::wind.on(preset) || force::air.on(preset)) text += " -D WIND";
  if (force::air.on(preset)) text += " -D AIR";
  return text;
}

}  // namespace tyglab::opencl
