#include "app/base/preset_files.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <system_error>

#include "app/base/data_files.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"

namespace tyglab {
namespace fs = std::filesystem;

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
  if (const auto near = nearest(name_or_file, known)) problem += " Did you mean '" + std::string(*near) + "'?";
  throw PresetError(problem + " `tyglab presets` lists the shipped ones.");
}

}  // namespace tyglab
