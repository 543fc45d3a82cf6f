// Presets with textures of the user's: saved beside the file, read from its folder.
#include <doctest/doctest.h>

#include "app/base/files.h"
#include "app/session/document.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "tests/app/desk.h"
#include "tests/support/files.h"

namespace tyglab::preset_files_test {

namespace fs = std::filesystem;

/// What a preset saved there says of its texture.
std::string texture_in(const fs::path& file) {
  return load_preset(file).texture;
}

Preset with_texture(const std::string& texture) {
  Preset preset;
  preset.texture = texture;
  return preset;
}

TEST_CASE("a texture from elsewhere is copied beside the preset, under a name that is free") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "images");
  fs::create_directories(folder / "saved");
  test::write_file(folder / "images/mine.png", "mine");
  const Preset chosen = with_texture((folder / "images/mine.png").string());
  const Preset saved = write_preset(chosen, folder / "saved/a.json");
  CHECK(texture_in(folder / "saved/a.json") == "mine.png");
  CHECK(saved.texture == (folder / "saved/mine.png").string());
  CHECK(test::read_file(saved.texture) == "mine");
  CHECK(read_preset(folder / "saved/a.json") == saved);
  // Again: it is there. Another of that name gets its own.
  write_preset(chosen, folder / "saved/b.json");
  CHECK(texture_in(folder / "saved/b.json") == "mine.png");
  write_preset(saved, folder / "saved/c.json");
  CHECK(texture_in(folder / "saved/c.json") == "mine.png");
  test::write_file(folder / "images/mine.png", "another");
  write_preset(chosen, folder / "saved/d.json");
  CHECK(texture_in(folder / "saved/d.json") == "mine-2.png");
  CHECK(test::read_file(folder / "saved/mine.png") == "mine");
  // Not under a shipped name, which would mean that one.
  test::write_file(folder / "images/denim.png", "blue");
  write_preset(with_texture((folder / "images/denim.png").string()), folder / "saved/e.json");
  CHECK(texture_in(folder / "saved/e.json") == "denim-2.png");
  // A link out of the folder is no file in it.
  fs::create_symlink("../images/denim.png", folder / "saved/link.png");
  const Preset linked = write_preset(with_texture((folder / "saved/link.png").string()), folder / "saved/f.json");
  CHECK(texture_in(folder / "saved/f.json") == "link-2.png");
  CHECK(test::read_file(linked.texture) == "blue");
}

TEST_CASE("shipped textures and those in the folder keep their names") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "sub");
  test::write_file(folder / "sub/own.png", "own");
  CHECK(write_preset(with_texture("linen.png"), folder / "a.json").texture == "linen.png");
  CHECK(texture_in(folder / "a.json") == "linen.png");
  write_preset(with_texture((folder / "sub/own.png").string()), folder / "b.json");
  CHECK(texture_in(folder / "b.json") == "sub/own.png");
  CHECK(read_preset(folder / "b.json").texture == (folder / "sub/own.png").string());
  CHECK(chosen_texture("linen.png") == "linen.png");
  CHECK(chosen_texture("x/y.png") == (fs::current_path() / "x/y.png").string());
}

TEST_CASE("a preset whose texture is gone is not saved, and the older file is kept") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "a.json", "older");
  CHECK_THROWS_AS(write_preset(with_texture("/nowhere/gone.png"), folder / "a.json"), OutputError);
  CHECK(test::read_file(folder / "a.json") == "older");
}

TEST_CASE("saving in the window says that it copied the texture, and nothing is unsaved then") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "saved");
  test::write_file(folder / "mine.png", "mine");
  test::Desk desk(with_texture((folder / "mine.png").string()));
  REQUIRE(save_document_as(desk.session, folder / "saved/a.json", "A"));
  CHECK(desk.session.messages.list().back().text ==
        "Saved " + (folder / "saved/a.json").string() + " and its texture mine.png");
  CHECK(desk.session.preset().texture == (folder / "saved/mine.png").string());
  CHECK_FALSE(unsaved(desk.session));
  open_document(desk.session, folder / "saved/a.json", false);
  CHECK(desk.session.preset().texture == (folder / "saved/mine.png").string());
}

}  // namespace tyglab::preset_files_test
