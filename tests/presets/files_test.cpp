// Presets as files: reading, atomic writing, the shipped ones.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "core/theory/advice.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace tyglab::files_test {

namespace fs = std::filesystem;

int files_in(const fs::path& folder) {
  return int(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string load_error(const fs::path& file) {
  try {
    load_preset(file);
  } catch (const PresetError& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("saved presets are loaded") {
  const test::TemporaryFolder folder;
  Preset preset;
  preset.name = "Saved";
  preset.k_s = 123;
  save_preset(preset, folder / "a b å.json");
  CHECK(load_preset(folder / "a b å.json") == preset);
  preset.k_s = 124;
  save_preset(preset, folder / "a b å.json");
  CHECK(load_preset(folder / "a b å.json") == preset);
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a missing, empty or unreadable file is an error with its name") {
  const test::TemporaryFolder folder;
  CHECK(load_error(folder / "missing.json").find("missing.json") != std::string::npos);
  CHECK(load_error(folder.path()).find(folder.path().string()) != std::string::npos);
  test::write_file(folder / "empty.json", "");
  CHECK(load_error(folder / "empty.json").find("empty.json") != std::string::npos);
  test::write_file(folder / "large.json", std::string(20u << 20, ' '));
  CHECK(load_error(folder / "large.json").find("large.json") != std::string::npos);
  CHECK_FALSE(load_error("/dev/zero").empty());
}

TEST_CASE("a write that fails leaves the old file and nothing else") {
  const test::TemporaryFolder folder;
  save_preset({}, folder / "kept.json");
  const std::string before = test::read_file(folder / "kept.json");
  CHECK_THROWS_AS(save_preset({}, folder / "no such folder" / "new.json"), OutputError);
  CHECK_THROWS_AS(save_preset({}, folder.path()), OutputError);
  CHECK_THROWS_AS(save_preset({}, "/dev/full/x.json"), OutputError);
  CHECK_THROWS_AS(write_atomically("", "text"), OutputError);
  CHECK(test::read_file(folder / "kept.json") == before);
  CHECK(files_in(folder.path()) == 1);
}

TEST_CASE("a reader sees the old file or the new one, never a part") {
  // Hold the old file open while it is replaced: it must stay whole under its descriptor.
  const test::TemporaryFolder folder;
  const fs::path file = folder / "file.txt";
  write_atomically(file, std::string(100000, 'a'));
  std::FILE* old = std::fopen(file.c_str(), "rb");
  REQUIRE(old != nullptr);
  write_atomically(file, "b");
  std::string text(100001, ' ');
  text.resize(std::fread(text.data(), 1, text.size(), old));
  std::fclose(old);
  CHECK(text == std::string(100000, 'a'));
  CHECK(test::read_file(file) == "b");
}

TEST_CASE("a link is written through, not replaced") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "real.json", "old");
  fs::create_symlink(folder / "real.json", folder / "link.json");
  write_atomically(folder / "link.json", "new");
  CHECK(fs::is_symlink(folder / "link.json"));
  CHECK(test::read_file(folder / "real.json") == "new");
  // A link to what is not there yet makes it; a circle of links is refused.
  fs::create_symlink("later.json", folder / "early.json");
  write_atomically(folder / "early.json", "late");
  CHECK(test::read_file(folder / "later.json") == "late");
  CHECK(fs::is_symlink(folder / "early.json"));
  fs::create_symlink("circle.json", folder / "circle.json");
  CHECK_THROWS_AS(write_atomically(folder / "circle.json", "text"), OutputError);
}

TEST_CASE("a preset in a file names no texture outside its folder") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "mine/sub");
  const auto with_texture = [&](const std::string& texture) {
    Preset preset;
    preset.texture = texture;
    test::write_file(folder / "mine/a.json", preset_to_json(preset));
    return load_error(folder / "mine/a.json");
  };
  test::write_file(folder / "secret.png", "x");
  test::write_file(folder / "mine/own.png", "x");
  test::write_file(folder / "mine/sub/own.png", "x");
  fs::create_symlink("own.png", folder / "mine/inside.png");
  fs::create_symlink("../secret.png", folder / "mine/outside.png");
  fs::create_directory_symlink("..", folder / "mine/up");
  for (const char* texture : {"denim.png", "own.png", "./own.png", "sub/own.png", "inside.png", "missing.png",
                              "no/such/folder.png", "..png", ""}) {
    CAPTURE(std::string(texture));
    CHECK(with_texture(texture) == "");
  }
  const std::string absolute = (folder / "mine/own.png").string();
  for (const std::string& texture :
       {std::string("../secret.png"), std::string("sub/../../secret.png"), std::string("sub/../own.png"),
        std::string(".."), absolute, std::string("/dev/zero"), std::string("outside.png"),
        std::string("up/secret.png")}) {
    CAPTURE(texture);
    const std::string error = with_texture(texture);
    CAPTURE(error);
    CHECK(error.find("a.json:") != std::string::npos);
    CHECK(error.find("view.texture: '" + texture + "' ") != std::string::npos);
    CHECK(error.find("allowed: a shipped texture's name, or an image in the preset's own folder") != std::string::npos);
  }
  // What no file says is the user's own.
  Preset preset;
  preset.texture = absolute;
  CHECK(parse_preset(preset_to_json(preset), "the last session") == preset);
}

TEST_CASE("bow stays within its limit with every B that its page has one try") {
  Preset bow = load_preset(std::string(test::source_dir) + "/app/presets/bow.json");
  for (const double B : {0.2, 0.02, 0.002}) {
    bow.B = B;
    CHECK(bow.dt <= advised_dt(bow, bow.integrator));
  }
}

TEST_CASE("every shipped preset is valid, has a name and a description, and the contract's names are there") {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(std::string(test::source_dir) + "/app/presets")) {
    if (entry.path().extension() != ".json") continue;
    CAPTURE(entry.path().string());
    const Preset preset = load_preset(entry.path());
    CHECK(check_preset(preset) == "");
    CHECK(preset.name != Preset{}.name);
    CHECK(preset.description.size() > 20);
    CHECK(fs::exists(fs::path(std::string(test::source_dir) + "/textures") / preset.texture));
    names.push_back(entry.path().stem().string());
  }
  CHECK(names.size() >= 10);
  for (const char* name : {"hanging", "denim", "rubber_mat", "curtain", "flag", "sphere", "taut_sheet", "tearing",
                           "one_weight", "explodes"}) {
    CAPTURE(std::string(name));
    CHECK(std::find(names.begin(), names.end(), name) != names.end());
  }
}

}  // namespace tyglab::files_test
