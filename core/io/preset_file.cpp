#include "core/io/files.h"
#include "core/io/input_file.h"
#include "core/io/preset_io.h"

namespace tyglab {
namespace {

constexpr std::uintmax_t max_file_size = 16u << 20;

}  // namespace

Preset load_preset(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found)
    throw PresetError(file.string() + ": there is no such file; `tyglab presets` lists the shipped ones");
  std::string text;
  try {
    text = read_input(file, "preset", max_file_size);
  } catch (const InputError& problem) {
    throw PresetError(problem.what());
  }
  return parse_preset(text, file.string(), file.has_parent_path() ? file.parent_path() : ".");
}

void save_preset(const Preset& preset, const std::filesystem::path& file) {
  write_atomically(file, preset_to_json(preset));
}

}  // namespace tyglab
