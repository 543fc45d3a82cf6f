#include <fstream>
#include <sstream>

#include "core/io/files.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

constexpr std::uintmax_t max_file_size = 16u << 20;

}  // namespace

Preset load_preset(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error))
    throw PresetError(file.string() + ": is a folder; name a preset file in it");
  if (std::filesystem::exists(file, error) && !std::filesystem::is_regular_file(file, error))
    throw PresetError(file.string() + ": is not a file, so it cannot be read as a preset");
  if (!std::filesystem::is_regular_file(file, error))
    throw PresetError(file.string() + ": there is no such file; `tyglab presets` lists the shipped ones");
  if (const auto size = std::filesystem::file_size(file, error); error || size > max_file_size)
    throw PresetError(file.string() + ": too large for a preset (16 MiB at most)");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw PresetError(file.string() + ": cannot be read; check its permissions");
  return parse_preset(text.str(), file.string(), file.has_parent_path() ? file.parent_path() : ".");
}

void save_preset(const Preset& preset, const std::filesystem::path& file) {
  write_atomically(file, preset_to_json(preset));
}

}  // namespace tyglab
