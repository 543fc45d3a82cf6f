// Settings on disk: written beside the frames, merged with those of other windows, and never lost.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/base/settings.h"
#include "app/shell/sandbox.h"
#include "core/io/output_file.h"
#include "core/io/preset_io.h"
#include "tests/support/files.h"

namespace tyglab::settings_file_test {

namespace fs = std::filesystem;

/// A settings folder of its own while one lives.
class Desk {
 public:
  Desk() { ::setenv("TYGLAB_CONFIG_DIR", folder.path().c_str(), 1); }
  ~Desk() { ::unsetenv("TYGLAB_CONFIG_DIR"); }
  Desk(const Desk&) = delete;
  Desk& operator=(const Desk&) = delete;

  fs::path file() const { return folder / "settings.json"; }
  nlohmann::json json() const { return nlohmann::json::parse(test::read_file(file())); }

  test::TemporaryFolder folder;
};

Settings loaded() {
  std::string problem;
  const Settings settings = load_settings(problem);
  CHECK_MESSAGE(problem.empty(), problem);
  return settings;
}

std::string problem_now() {
  std::string problem;
  CHECK(load_settings(problem) == Settings());
  return problem;
}

Settings unusual() {
  Settings settings;
  settings.x = 5, settings.y = 6, settings.width = 1000, settings.height = 700;
  settings.maximised = settings.plot_log = settings.all_effects = settings.tour_seen = true;
  settings.ui_scale = 1.5;
  settings.theme = "light";
  settings.color = "strain";
  settings.layout.left_width = 250;
  settings.layout.map = true;
  settings.layout.folded = {"Start"};
  settings.handling.slow_hand = true;
  settings.handling.arrows = {"F_g"};
  settings.labs = {{"01_hooke", 3}};
  settings.session.emplace();
  settings.session->preset.k_s = 77;
  settings.session->label = "mine";
  settings.session->file = "/somewhere/mine.json";
  return settings;
}

TEST_CASE("settings come back as they were") {
  const Desk desk;
  CHECK(loaded() == Settings());
  save_settings(unusual(), Settings());
  CHECK(loaded() == unusual());
  save_settings(unusual(), unusual());
  CHECK(loaded() == unusual());
}

TEST_CASE("values that no window can have become the nearest that one can") {
  const Desk desk;
  test::write_file(desk.file(), "{\"window\": {\"width\": -5, \"height\": 1e9}, \"ui_scale\": -3}");
  const Settings settings = loaded();
  CHECK(settings.width == 480);
  CHECK(settings.height == 16384);
  CHECK(settings.ui_scale == 1);
}

TEST_CASE("two windows keep each other's changes; of one value the last change counts") {
  const Desk desk;
  save_settings(Settings(), Settings());
  const Settings known = loaded();
  Settings a = known, b = known;
  a.theme = "light", a.layout.map = true, a.labs["01_hooke"] = 2, a.ui_scale = 2;
  b.layout.left_width = 250, b.labs["02_euler"] = 4, b.ui_scale = 1.5;
  b.session.emplace().label = "b";
  save_settings(a, known);
  save_settings(b, known);
  Settings both = loaded();
  CHECK(both.theme == "light");
  CHECK(both.layout.map);
  CHECK(both.layout.left_width == 250);
  CHECK(both.labs == std::map<std::string, int>{{"01_hooke", 2}, {"02_euler", 4}});
  CHECK(both.ui_scale == 1.5);
  REQUIRE(both.session.has_value());
  CHECK(both.session->label == "b");
  // Who changed nothing since takes nothing back.
  save_settings(a, a);
  CHECK(loaded() == both);
  // What was removed is removed.
  a.labs.erase("01_hooke");
  Settings before = a;
  before.labs["01_hooke"] = 2;
  save_settings(a, before);
  both.labs.erase("01_hooke");
  CHECK(loaded() == both);
}

TEST_CASE("two processes that write at the same time lose no change") {
  const Desk desk;
  save_settings(Settings(), Settings());
  constexpr int changes = 40;
  std::vector<pid_t> writers;
  for (const char* name : {"a", "b", "c"}) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      Settings known, now;
      int lost = 0;
      for (int n = 1; n <= changes; ++n) {
        now.labs[name] = n;
        try {
          save_settings(now, known);
          known = now;
        } catch (const OutputError&) {  // it had to wait too long: the next one brings it
          ++lost;
        }
      }
      if (known != now) save_settings(now, known);
      ::_exit(lost == changes ? 1 : 0);
    }
    writers.push_back(child);
  }
  for (const pid_t writer : writers) {
    int status = 0;
    REQUIRE(::waitpid(writer, &status, 0) == writer);
    CHECK(status == 0);
  }
  CHECK(loaded().labs == std::map<std::string, int>{{"a", changes}, {"b", changes}, {"c", changes}});
}

TEST_CASE("unusable settings are kept aside, each under a name of its own, with the line and the key") {
  const Desk desk;
  struct Wrong {
    const char *text, *said;
  };
  int n = 0;
  for (const Wrong& wrong :
       {Wrong{"[]", "line 1: the file must be an object {…}, not a list"}, Wrong{"", "line 1: it is empty"},
        Wrong{"{\n\"theme\": 5}", "line 2: theme must be a string, not a whole number"},
        Wrong{"{\"window\": {\n\n\"x\": \"left\"}}", "line 3: window.x must be a number, not a string"},
        Wrong{"{\n\"theme\": \"dark\"\n\"labs\": {}}", "line 3: column 1: a comma is missing"},
        Wrong{"{\n\"labs\": {\"a\": true}}", "line 2: labs.a must be a number"},
        Wrong{"{\"session\": {}}", "line 1: session.preset is missing"},
        Wrong{"{\"layout\": {\"folded\": 3}}", "line 1: layout.folded must be a list of strings"},
        Wrong{"{\"layout\":\n5}", "line 2: layout must be an object"},
        Wrong{"{\"ui_scale\":\n1e999}", "line 2: column 1: ui_scale: 1e999 is too large"},
        Wrong{"{\"session\": {\"preset\": {\n\"forces\": {\n\"k_s\": -1}}}}",
              "line 3: session.preset.forces.k_s: -1 is not allowed"}}) {
    CAPTURE(std::string(wrong.text));
    test::write_file(desk.file(), wrong.text);
    const std::string problem = problem_now();
    CHECK_MESSAGE(problem.find(wrong.said) != std::string::npos, problem);
    const std::string aside = desk.file().string() + ".broken" + (++n == 1 ? "" : "-" + std::to_string(n));
    CHECK(problem.find(aside + ".") != std::string::npos);
    CHECK(test::read_file(aside) == wrong.text);
    CHECK_FALSE(fs::exists(desk.file()));
  }
}

TEST_CASE("settings that are a pipe, a folder, a device or huge hold nobody up") {
  const Desk desk;
  const auto check = [&](const char* said) {
    const std::string problem = problem_now();
    CHECK_MESSAGE(problem.find(said) != std::string::npos, problem);
    CHECK(problem.find("The defaults are used") != std::string::npos);
    save_settings(unusual(), Settings());
    CHECK(loaded() == unusual());
    fs::remove(desk.file());
  };
  REQUIRE(::mkfifo(desk.file().c_str(), 0600) == 0);
  check("is not a file");
  fs::create_directory(desk.file());
  check("is a folder");
  fs::create_symlink("/dev/zero", desk.file());
  check("is not a file");
  test::write_file(desk.file(), "{}");
  fs::resize_file(desk.file(), std::uintmax_t{3} << 30);
  check("too large");
  // One that becomes a pipe later is not waited for either.
  REQUIRE(::mkfifo(desk.file().c_str(), 0600) == 0);
  CHECK_THROWS_AS(save_settings(unusual(), Settings()), OutputError);
}

TEST_CASE("settings of a newer version are kept aside and never overwritten") {
  const Desk desk;
  const std::string newer = "{\"tyglab_settings\": 2, \"theme\": {\"name\": \"new\"}}";
  for (const char* aside : {"settings.json.version-2", "settings.json.version-2-2"}) {
    test::write_file(desk.file(), newer);
    const std::string problem = problem_now();
    CHECK(problem.find("newer Tyglab") != std::string::npos);
    CHECK(problem.find(aside) != std::string::npos);
    CHECK(test::read_file(desk.folder / aside) == newer);
  }
  // Nor one that a newer window writes while this one is open.
  test::write_file(desk.file(), newer);
  CHECK_THROWS_AS(save_settings(unusual(), Settings()), OutputError);
  CHECK(test::read_file(desk.file()) == newer);
}

TEST_CASE("what another program left there meanwhile is kept aside, and the settings are written whole") {
  const Desk desk;
  save_settings(unusual(), Settings());
  test::write_file(desk.file(), "{ half");
  Settings now = unusual();
  now.theme = "dark";
  save_settings(now, unusual());
  CHECK(loaded() == now);
  CHECK(test::read_file(desk.file().string() + ".broken") == "{ half");
}

TEST_CASE("settings are private if they were, stay a link if they are, and keep what this program does not know") {
  const Desk desk;
  test::write_file(desk.folder / "dotfile.json", "{\"extension\": [1, 2]}");
  REQUIRE(::chmod((desk.folder / "dotfile.json").c_str(), 0600) == 0);
  fs::create_symlink("dotfile.json", desk.file());
  save_settings(unusual(), Settings());
  CHECK(fs::is_symlink(desk.file()));
  CHECK(fs::status(desk.file()).permissions() == fs::perms(0600));
  CHECK(desk.json()["extension"] == nlohmann::json{1, 2});
  CHECK(desk.json()["theme"] == "light");
}

/// Calls update until the writer has nothing left to do at that time; whether it said something.
bool settle(SettingsWriter& writer, double now, const Settings& settings, Messages& messages) {
  bool said = false;
  for (int n = 0; n < 200; ++n) {
    said = writer.update(
               now, [&] { return settings; }, messages) ||
           said;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return said;
}

TEST_CASE(
    "a change is on disk within two seconds, without the frames waiting, and without a write where nothing changed") {
  const Desk desk;
  Settings settings;
  SettingsWriter writer(settings);
  Messages messages;
  settle(writer, 0, settings, messages);
  CHECK_FALSE(fs::exists(desk.file()));
  settings.labs["01_hooke"] = 1;
  // From now on for 1.5 s of its clock, however long the disk takes.
  for (const double now : {0.1, 0.6, 1.6}) settle(writer, now, settings, messages);
  CHECK(loaded() == settings);
  fs::remove(desk.file());
  settle(writer, 10, settings, messages);
  CHECK_FALSE(fs::exists(desk.file()));
  settings.theme = "light";
  writer.finish(settings);
  CHECK(loaded() == settings);
  CHECK(messages.list().empty());
}

TEST_CASE("settings that cannot be written are said once, tried again, and written when they can be") {
  const Desk desk;
  fs::create_directory(desk.file());
  Settings settings;
  SettingsWriter writer(settings);
  Messages messages;
  settings.theme = "light";
  CHECK(settle(writer, 0, settings, messages));
  REQUIRE(messages.list().size() == 1);
  CHECK(messages.list()[0].text.find("not remembered until") != std::string::npos);
  CHECK_FALSE(settle(writer, 20, settings, messages));
  fs::remove(desk.file());
  settle(writer, 40, settings, messages);
  CHECK(loaded() == settings);
}

TEST_CASE("kill -9 at any moment leaves settings that can be read, no older than the write before") {
  const Desk desk;
  for (int round = 0; round < 20; ++round) {
    Settings first;
    first.labs["step"] = 0;
    save_settings(first, Settings());
    std::array<int, 2> ends{};
    REQUIRE(::pipe(ends.data()) == 0);
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      Settings now = first;
      Messages messages;
      SettingsWriter writer(first);
      for (double t = 0;; t += 1) {
        now.labs["step"] = int(t) + 1;
        writer.finish(now);
        const char done = 1;
        if (::write(ends[1], &done, 1) != 1) ::_exit(1);
      }
    }
    ::close(ends[1]);
    std::this_thread::sleep_for(std::chrono::microseconds(3000 + 731 * round));
    ::kill(child, SIGKILL);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    int written = 0;
    std::array<char, 4096> marks{};
    for (ssize_t n = 0; (n = ::read(ends[0], marks.data(), marks.size())) > 0;) written += int(n);
    ::close(ends[0]);
    const int step = loaded().labs.at("step");
    CHECK(step >= written);
    CHECK(step <= written + 1);
  }
}

}  // namespace tyglab::settings_file_test
