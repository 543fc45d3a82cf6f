#include "app/base/preset_files.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "app/base/data_files.h"
#include "core/io/files.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/model/readable.h"

namespace tyglab {
namespace fs = std::filesystem;
namespace {

fs::path folder_of(const fs::path& file) {
  return fs::absolute(file).lexically_normal().parent_path();
}

std::string in_folder(const fs::path& folder, const std::string& name) {
  return name.empty() || is_shipped_texture(name) ? name : (folder / name).lexically_normal().string();
}

/// Nothing if it cannot be read.
std::optional<std::string> content_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in || !text) return std::nullopt;
  return std::move(text).str();
}

/// The name by which a preset in that folder may call the image, which is copied into it where it is not there.
std::string name_in(const fs::path& folder, const std::string& texture) {
  if (texture.empty() || is_shipped_texture(texture)) return texture;
  const fs::path image = fs::absolute(texture);
  const std::string inside = image.lexically_relative(folder).string();
  if (!inside.empty() && !is_shipped_texture(inside) && texture_problem(inside, folder).empty()) return inside;
  const std::optional<std::string> bytes = content_of(image);
  if (!bytes)
    throw OutputError("The texture " + texture +
                      " cannot be read, so it cannot be copied beside the preset. Choose another texture, then save");
  for (int n = 1;; ++n) {
    const std::string name = n == 1 ? image.filename().string()
                                    : image.stem().string() + "-" + std::to_string(n) + image.extension().string();
    if (is_shipped_texture(name)) continue;
    std::error_code error;
    const bool taken = fs::exists(fs::symlink_status(folder / name, error));
    if (taken && content_of(folder / name) != bytes) continue;
    if (!taken) write_atomically(folder / name, *bytes);
    if (texture_problem(name, folder).empty()) return name;
  }
}

}  // namespace

std::vector<std::string> shipped_presets() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(data_file("presets")))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

bool is_preset(const std::string& name_or_file) {
  const std::vector<std::string> names = shipped_presets();
  std::error_code error;
  return std::binary_search(names.begin(), names.end(), name_or_file) || fs::exists(name_or_file, error);
}

PresetSource find_preset(const std::string& name_or_file, const std::vector<std::string>& commands) {
  const std::vector<std::string> names = shipped_presets();
  if (std::binary_search(names.begin(), names.end(), name_or_file))
    return {data_file("presets/" + name_or_file + ".json"), name_or_file};
  std::error_code error;
  const fs::path file(name_or_file);
  if (fs::exists(file, error)) return {file, file.stem().string()};
  std::string problem =
      "'" + name_or_file + "' is neither " + (commands.empty() ? "" : "a command, ") + "a shipped preset nor a file.";
  std::vector<std::string_view> known(names.begin(), names.end());
  known.insert(known.end(), commands.begin(), commands.end());
  const auto near = nearest(name_or_file, known);
  throw PresetError(problem + (near ? " Did you mean '" + std::string(*near) + "'?"
                                    : " The shipped presets are " + joined(names) + "." +
                                          (commands.empty() ? "" : " `tyglab --help` lists the commands.")));
}

Preset read_preset(const fs::path& file) {
  Preset preset = load_preset(file);
  preset.texture = in_folder(folder_of(file), preset.texture);
  return preset;
}

std::string chosen_texture(const std::string& name_or_file) {
  return in_folder(fs::current_path(), name_or_file);
}

Preset write_preset(Preset preset, const fs::path& file) {
  const fs::path folder = folder_of(file);
  preset.texture = name_in(folder, preset.texture);
  save_preset(preset, file);
  preset.texture = in_folder(folder, preset.texture);
  return preset;
}

}  // namespace tyglab
