
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "app/base/experiment_file.h"
#include "app/base/files.h"
#include "app/base/settings.h"
#include "core/io/json_tree.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"

namespace tyglab {
namespace fs = std::filesystem;

namespace {

fs::path& given_folder() {
  static fs::path folder;
  return folder;
}

}  // namespace

void set_data_folder(const fs::path& folder) {
  given_folder() = folder;
}

const fs::path& data_folder() {
  if (!given_folder().empty()) return given_folder();
  static const fs::path folder = [] {
    try {
      return data_folder_beside(program_file().parent_path());
    } catch (const fs::filesystem_error& error) {
      throw DataFileError(std::string("The folder of the program cannot be found (") + error.what() +
                          "). Is /proc mounted?");
    }
  }();
  return folder;
}

fs::path data_file(std::string_view name) {
  fs::path file = data_folder() / name;
  std::error_code error;
  if (!fs::exists(file, error)) {
    throw DataFileError("The program's file " + file.string() +
                        " is missing. Rebuild (app/run), or reinstall with cmake --install.");
  }
  return file;
}

bool is_shipped_texture(const std::string& name) {
  const fs::path given(name);
  std::error_code error;
  return given.has_filename() && !given.has_parent_path() && fs::exists(data_folder() / "textures" / given, error);
}

fs::path texture_file(const std::string& name) {
  return is_shipped_texture(name) ? data_folder() / "textures" / name : fs::path(name);
}

namespace {

/// The letters from U+00C0 to U+017F without their marks; '_' for what is no letter.
constexpr std::string_view plain_letters =
    "aaaaaaaceeeeiiiidnooooo_ouuuuytsaaaaaaaceeeeiiiidnooooo_ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkklllllll"
    "lllnnnnnnnnnoooooooorrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";
constexpr std::uint32_t first_marked = 0xC0, end_marked = 0x180;
static_assert(plain_letters.size() == end_marked - first_marked);

/// The code point that begins there, of which `at` is moved to the end; 0 where the text is not UTF-8.
std::uint32_t next_code_point(std::string_view text, std::size_t& at) {
  const auto byte = [&](std::size_t n) { return n < text.size() ? std::uint32_t(std::uint8_t(text[n])) : 0; };
  const std::uint32_t first = byte(at++);
  if (first < 0x80) return first;
  if ((first & 0xE0) == 0xC0 && (byte(at) & 0xC0) == 0x80) return (first & 0x1F) << 6 | (byte(at++) & 0x3F);
  while ((byte(at) & 0xC0) == 0x80) ++at;
  return 0;
}

char plain_letter(std::uint32_t letter) {
  if ((letter >= 'a' && letter <= 'z') || (letter >= '0' && letter <= '9')) return char(letter);
  if (letter >= 'A' && letter <= 'Z') return char(letter - 'A' + 'a');
  return letter >= first_marked && letter < end_marked ? plain_letters[letter - first_marked] : '_';
}

}  // namespace

std::string plain_file_name(std::string_view name) {
  std::string file;
  for (std::size_t at = 0; at < name.size();) {
    const std::uint32_t letter = next_code_point(name, at);
    // Marks that follow their letter (U+0300 to U+036F) are left out too.
    if (letter >= 0x300 && letter < 0x370) continue;
    const char plain = plain_letter(letter);
    if (plain != '_' || (!file.empty() && file.back() != '_')) file += plain;
  }
  while (!file.empty() && file.back() == '_') file.pop_back();
  return file;
}

namespace fs = std::filesystem;

std::optional<FileStamp> stamp_of(const fs::path& file) {
  std::error_code no_time, no_size;
  const FileStamp stamp{file, fs::last_write_time(file, no_time), fs::file_size(file, no_size)};
  return no_time || no_size ? std::nullopt : std::optional(stamp);
}

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
  std::string problem = "'" + excerpt(name_or_file, 300) + "' is neither " + (commands.empty() ? "" : "a command, ") +
                        "a shipped preset nor a file.";
  std::vector<std::string_view> known(names.begin(), names.end());
  known.insert(known.end(), commands.begin(), commands.end());
  const auto near = nearest(name_or_file, known);
  throw PresetError(problem + (near ? " Did you mean '" + std::string(*near) + "'?"
                                    : " The shipped presets are " + joined(names) + "." +
                                          (commands.empty() ? "" : " `tyglab --help` lists the commands.")));
}

Preset read_preset(const fs::path& file) {
  if (is_experiment(file)) return load_experiment(file).recording.start();
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
