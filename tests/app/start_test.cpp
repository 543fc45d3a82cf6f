// What a session finds of the last one and leaves to the next.
#include "app/shell/start.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

#include "tests/app/desk.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace tyglab::start_test {

namespace fs = std::filesystem;

/// Settings in a folder, as a start finds them.
struct Folder {
  explicit Folder(const fs::path& folder) { REQUIRE(setenv("TYGLAB_CONFIG_DIR", folder.c_str(), 1) == 0); }
  ~Folder() { unsetenv("TYGLAB_CONFIG_DIR"); }
  Settings start(int frames = 0) {
    SandboxOptions options;
    options.frames = frames;
    return settings_for(options, messages);
  }
  Messages messages;
};

TEST_CASE("settings that cannot be read are kept beside, and said in plain words") {
  const test::TemporaryFolder own;
  test::write_file(own / "settings.json", "[]");
  Folder folder(own.path());
  CHECK(folder.start().theme == Settings().theme);
  REQUIRE(folder.messages.list().size() == 1);
  const std::string& said = folder.messages.list()[0].text;
  CHECK(said.find("settings.json.broken") != std::string::npos);
  CHECK(said.find("exception") == std::string::npos);
  CHECK(test::read_file(own / "settings.json.broken") == "[]");
}

TEST_CASE("a folder of settings that cannot be written is said at once") {
  const test::TemporaryFolder own;
  test::write_file(own / "file", "in the way");  // which stops even an administrator
  Folder folder(own / "file/config");
  folder.start();
  REQUIRE(folder.messages.list().size() == 1);
  CHECK(folder.messages.list()[0].text.find("will not be remembered") != std::string::npos);
}

TEST_CASE("with --frames nothing of earlier sessions counts, and no settings are written") {
  const test::TemporaryFolder own;
  Folder folder(own.path());
  Settings light;
  light.theme = "light";
  save_settings(light, Settings());
  CHECK(folder.start().theme == "light");
  CHECK(folder.start(3).theme == Settings().theme);
  CHECK(folder.messages.list().empty());
}

TEST_CASE(
    "the next session begins with the labs done, the scales and the preset; unsaved changes only if interrupted") {
  test::Desk desk(test::cloth(8, 8));
  desk.session.document.label = "mine", desk.session.document.file = "/a/mine.json";
  Preset changed = desk.session.preset();
  changed.k_s = 77, changed.mode = 4;
  desk.session.propose(changed);
  desk.act();
  desk.session.labs.progress = {{"01_hooke", 3}};
  desk.ui.plots.log = true;
  remember_session(desk.ui);
  CHECK(desk.settings.labs == std::map<std::string, int>{{"01_hooke", 3}});
  CHECK(desk.settings.plot_log);
  REQUIRE(desk.settings.session.has_value());
  CHECK(desk.settings.session->preset == changed);
  CHECK(desk.settings.session->label == "mine");
  CHECK(desk.settings.session->file == "/a/mine.json");
  desk.session.quit = true;
  remember_session(desk.ui);
  CHECK(desk.settings.session->preset.k_s == desk.session.document.saved.k_s);
  CHECK(desk.settings.session->preset.mode == 4);
}

}  // namespace tyglab::start_test
