#include "tests/fuzz/targets.h"

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "app/base/settings.h"
#include "app/render/image.h"
#include "app/session/lab.h"
#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "tests/support/pictures.h"

namespace tyglab::fuzz {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void broken(const std::string& why) {
  std::fprintf(stderr, "\nDoes not hold: %s\n", why.c_str());
  std::abort();
}

void require(bool holds, const std::string& what) {
  if (!holds) broken(what);
}

/// Every refusal is an exception of this kind, and says why.
template <class Refusal, class Read>
void read_or_refuse(const Read& read) {
  try {
    read();
  } catch (const Refusal& refusal) {
    require(std::string(refusal.what()).size() >= 8, "a refusal says why");
  }
}

void require_good(const Preset& preset) {
  const std::string problem = check_preset(preset);
  require(problem.empty(), "what is accepted passes the check: " + problem);
  require(parse_preset(preset_to_json(preset), "again") == preset, "what is written is read as it was");
}

void read_preset_text(std::string_view input) {
  read_or_refuse<PresetError>([&] { require_good(parse_preset(input, "fuzz.json")); });
}

std::vector<std::string> lines(std::string_view text) {
  std::vector<std::string> all;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) all.push_back(line);
  return all;
}

/// A setting a line.
void read_settings(std::string_view input) {
  read_or_refuse<PresetError>([&] { require_good(with_settings(Preset{}, lines(input.substr(0, 4096)))); });
}

void read_lab(std::string_view input) {
  read_or_refuse<std::runtime_error>([&] { parse_lab(input, "fuzz.md"); });
}

void read_picture(std::string_view input) {
  read_or_refuse<std::runtime_error>([&] {
    const std::span bytes(reinterpret_cast<const unsigned char*>(input.data()), input.size());
    const Image image = decode_image(bytes, "the picture");
    require(image.width >= 1 && image.height >= 1 && image.width <= 4096 && image.height <= 4096,
            "a picture has an allowed size");
    require(image.rgb.size() == std::size_t(3) * image.width * image.height, "a picture has all its pixels");
  });
}

/// The file of the last session, in a folder of its own.
void read_settings_file(std::string_view input) {
  const fs::path folder = fs::temp_directory_path() / ("tyglab-fuzz-" + std::to_string(::getpid()));
  fs::remove_all(folder);
  fs::create_directory(folder);
  ::setenv("TYGLAB_CONFIG_DIR", folder.c_str(), 1);
  std::ofstream(folder / "settings.json", std::ios::binary).write(input.data(), std::streamsize(input.size()));
  std::string problem;
  const Settings settings = load_settings(problem);
  require(problem.empty() || problem.size() >= 8, "a refusal says why");
  require(!settings.session || check_preset(settings.session->preset).empty(), "a session's preset is good");
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> files_of(const char* folder, const char* extension) {
  std::vector<std::string> all;
  for (const auto& entry : fs::directory_iterator(fs::path(TYGLAB_SOURCE_DIR) / folder))
    if (entry.path().extension() == extension) all.push_back(content(entry.path()));
  return all;
}

std::vector<std::string> preset_seeds() {
  return files_of("app/presets", ".json");
}

std::vector<std::string> setting_seeds() {
  std::vector<std::string> all{"W=[0,0,0.02]", "bodies[0].shape=sphere\nbodies[0].r=0.3", "pins=[[0,0],[3,3]]"};
  for (const PresetRow& row : notation()) all.push_back(std::string(row.key) + "=1");
  return all;
}

std::vector<std::string> lab_seeds() {
  return files_of("docs/labs", ".md");
}

std::vector<std::string> picture_seeds() {
  std::vector<std::string> all = test::pictures_of_all_kinds(12);
  for (std::string& picture : files_of("tests/fuzz/pictures", ".jpg")) all.push_back(std::move(picture));
  return all;
}

std::vector<std::string> settings_file_seeds() {
  const std::string preset = preset_to_json(Preset{});
  return {R"({"tyglab_settings": 1, "theme": "light", "window": {"x": 1, "y": 2, "width": 800, "height": 600}})",
          R"({"tyglab_settings": 1, "session": {"label": "a", "file": "", "preset": )" + preset + R"(, "saved": )" +
              preset + "}}"};
}

constexpr Target all_targets[]{{"presets", read_preset_text, preset_seeds},
                               {"settings", read_settings, setting_seeds},
                               {"labs", read_lab, lab_seeds},
                               {"pictures", read_picture, picture_seeds},
                               {"sessions", read_settings_file, settings_file_seeds}};

}  // namespace

std::span<const Target> targets() {
  return all_targets;
}

}  // namespace tyglab::fuzz
