// Presets are saved and opened by dialogs; what is not saved is never lost without a question.
#include <doctest/doctest.h>

#include <algorithm>

#include "app/base/files.h"
#include "app/base/glfw_keys.h"
#include "app/session/requests.h"
#include "app/ui/constants/constants_panel.h"
#include "core/io/preset_io.h"
#include "core/model/fabric.h"
#include "tests/ui/null_ui.h"

namespace tyglab::documents_test {

namespace fs = std::filesystem;
constexpr int ctrl = GLFW_MOD_CONTROL, shift = GLFW_MOD_SHIFT;
using Kind = Dialog::Kind;

void open_dialog(test::NullUi& window, Kind kind) {
  window.key(kind == Kind::open ? GLFW_KEY_O : GLFW_KEY_S, kind == Kind::open ? ctrl : ctrl | shift);
  window.frames(3);
  REQUIRE(window.ui.dialog.kind == kind);
}

void save_as(test::NullUi& window, std::string_view name, const fs::path& file) {
  window.until([&] { return window.ui.dialog.kind == Kind::save; }, "the save dialog");
  window.fill("name", name);
  window.fill("path", file.string());
  window.click("dialog.Save");
}

TEST_CASE("a preset is saved to a file and loaded again; what is not saved is asked about first") {
  test::NullUi window;
  const fs::path file = window.config / "presets/stiff.json";
  window.type_value("k_s", "123");
  window.key(GLFW_KEY_S, ctrl);
  save_as(window, "Stiff cloth", file);
  CHECK(window.ui.dialog.kind == Kind::none);
  CHECK_FALSE(unsaved(window.session));
  CHECK(window.session.document.file == file);
  CHECK(window.preset().name == "Stiff cloth");
  const Preset saved = load_preset(file);
  CHECK(saved.k_s == 123);
  CHECK(saved.name == "Stiff cloth");
  CHECK(saved.description == "Based on “Hanging cloth”.");  // "The default scene." is said of another one
  const test::Outcome judged = test::tyglab(window.config.path(), {"presets", "check", file.string()});
  CHECK(judged.code == 0);

  window.type_value("k_s", "77");
  CHECK(unsaved(window.session));
  open_dialog(window, Kind::open);
  window.fill("path", file.string());
  window.click("dialog.Open");
  CHECK(window.ui.dialog.kind == Kind::unsaved);
  CHECK(window.preset().k_s == 77);
  window.click("dialog.Discard_the_changes");
  CHECK(window.preset().k_s == 123);
  CHECK(window.preset().name == "Stiff cloth");
  CHECK_FALSE(unsaved(window.session));
  CHECK(window.ui.dialog.kind == Kind::none);
}

TEST_CASE("the file follows a new name every time; a file that exists is replaced only after a question") {
  test::NullUi window;
  for (const auto& [name, file] : {std::pair{"First", "first.json"}, {"Second", "second.json"}}) {
    open_dialog(window, Kind::save);
    window.fill("name", name);
    window.click("dialog.Save");
    CHECK(window.ui.dialog.kind == Kind::none);
    CHECK(window.session.document.file.filename() == file);
  }
  open_dialog(window, Kind::save);
  window.click("dialog.Save");
  CHECK(window.sees("dialog.Replace"));
  window.key(GLFW_KEY_ESCAPE);
  CHECK(window.ui.dialog.kind == Kind::none);
}

TEST_CASE("what is typed into the save dialog replaces the name") {
  test::NullUi window;
  open_dialog(window, Kind::save);
  window.until([&] { return window.typing(); }, "the name's field");
  window.type("another");
  CHECK(std::string(window.ui.dialog.name) == "another");
  CHECK(fs::path(window.ui.dialog.path).filename() == "another.json");
}

TEST_CASE("a shipped preset is opened from the list; saving over it is refused") {
  test::NullUi window;
  open_dialog(window, Kind::open);
  window.click("dialog.entry.sphere");
  window.frames(2);
  CHECK(window.session.document.label == "sphere");
  CHECK(window.ui.dialog.kind == Kind::none);
  CHECK(window.session.document.file.empty());
  CHECK_FALSE(unsaved(window.session));
  const fs::path file = find_preset("sphere").file;
  const auto before = fs::last_write_time(file);
  open_dialog(window, Kind::save);
  save_as(window, "Sphere", file);
  if (window.sees("dialog.Replace")) window.click("dialog.Replace");
  CHECK(window.ui.dialog.problem.find("part of the program") != std::string::npos);
  CHECK(fs::last_write_time(file) == before);
  window.key(GLFW_KEY_ESCAPE);
  CHECK(window.ui.dialog.kind == Kind::none);
}

TEST_CASE("the start page has scenes and labs with pictures, narrowed by what is typed, and what one worked on") {
  test::NullUi window;
  const fs::path file = window.config / "presets/soft.json";
  open_dialog(window, Kind::save);
  save_as(window, "Soft and slow", file);
  CHECK(window.settings.recent == std::vector<std::string>{file.string()});
  CHECK(load_preset(file).description == "Based on “Hanging cloth”.");
  window.settings.tour_seen = false;
  window.click("top.brand");
  window.frames(2);
  CHECK(window.drew("Start with “Soft and slow”"));
  window.click(window.control_beginning("dialog.Start_with"));
  window.click("top.brand");
  window.frames(2);
  CHECK(window.drew("Continue with “"));
  REQUIRE(window.ui.dialog.kind == Kind::start);
  CHECK(window.drew("Recent work"));
  CHECK(window.sees("dialog.entry.Soft_and_slow"));
  CHECK(window.sees("dialog.entry.hanging"));
  CHECK_FALSE(window.drew(data_folder().string()));
  window.until([&] { return !window.ui.sketches.poll(); }, "all pictures");
  window.click("dialog.sections.3");
  window.frames(2);
  CHECK_FALSE(window.sees("dialog.entry.hanging"));
  window.until([&] { return window.sees("dialog.find"); }, "the field");
  window.click("dialog.find");
  window.until([&] { return window.typing(); }, "the field to take keys");
  window.type("hooke");
  window.frames(2);
  CHECK_FALSE(window.sees("dialog.entry.hanging"));
  window.key(GLFW_KEY_ENTER);
  window.frames(3);
  CHECK(window.ui.dialog.kind == Kind::none);
  REQUIRE(window.session.labs.run.has_value());
  CHECK(window.session.labs.run->lab.label == "01_hooke");
  CHECK(window.settings.recent.size() == 1);  // a lab's cloth is no work of the user's
}

TEST_CASE("a fabric is changed in its own units, with one undo each") {
  test::NullUi window({.with = [](Preset& preset) { preset = with_fabric(preset, fabrics()[0]), preset.dt = 1e-4; }});
  window.pause();
  CHECK_FALSE(window.sees("constants.fabric.mass.slider"));
  show_constant(window.ui, "k_shear");
  window.frames(10);

  window.click("constants.fabric_units");
  window.type_value("fabric.mass", "250");
  CHECK(window.preset().m == doctest::Approx(0.25 * window.preset().L * window.preset().L));
  window.key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  window.until([&] { return is_fabric(window.preset(), fabrics()[0]); }, "undo to take the mass back");
}

TEST_CASE("the start page shows the fabrics beside each other, after the other scenes") {
  test::NullUi window;
  window.ui.command("start_page");
  window.frames(2);
  std::vector<std::string> sections, fabrics_shown;
  for (const GalleryCard& card : window.ui.gallery.cards) {
    if (sections.empty() || sections.back() != card.section) sections.push_back(card.section);
    if (sections.back() == "Fabrics") fabrics_shown.push_back(card.entry.keys);
  }
  CHECK(sections == std::vector<std::string>{"Scenes", "Fabrics", "Labs"});
  std::vector<std::string> wanted;
  for (const Fabric& fabric : fabrics()) wanted.push_back("fabric_" + std::string(fabric.key));
  std::sort(wanted.begin(), wanted.end()), std::sort(fabrics_shown.begin(), fabrics_shown.end());
  CHECK(fabrics_shown == wanted);
  window.click("dialog.find");
  window.type("knit");
  window.frames(2);
  CHECK(window.drew("Fabrics"));
  CHECK(window.sees("dialog.entry.fabric_knit"));
}

TEST_CASE("the scene waits behind the start page, and starts where it stands once that is closed or something chosen") {
  test::NullUi window;
  window.key(GLFW_KEY_R);
  window.pause();
  window.key(GLFW_KEY_R);
  window.ui.command("start_page");
  window.key(GLFW_KEY_SPACE);
  window.frames(60);
  REQUIRE(window.ui.dialog.kind == Kind::start);
  CHECK(window.t() == 0);
  CHECK(window.session.idle());  // no frame is drawn for it
  window.key(GLFW_KEY_ESCAPE);
  window.frames(3);
  CHECK(window.t() > 0);
  CHECK(window.t() < 0.1);

  window.ui.command("start_page");
  window.frames(2);
  window.click("dialog.entry.sphere");
  window.until([&] { return window.session.document.label == "sphere"; }, "the scene");
  window.frames(3);
  CHECK_FALSE(window.paused());
  CHECK(window.t() > 0);
  CHECK(window.t() < 0.2);
}

TEST_CASE("what went wrong at the start is said on the start page, and for as long as that is open") {
  test::NullUi window;
  window.session.messages.warning("settings.json is damaged. The defaults are used.");
  window.ui.command("start_page");
  window.frames(2);
  for (int n = 0; n < 3; ++n) {
    window.ui.now += 5;
    window.frames(2);
    CHECK(window.drew("The defaults are used."));
  }
  window.key(GLFW_KEY_ESCAPE);
  window.frames(2);
  CHECK(window.session.messages.list().size() == 1);
}

TEST_CASE("a name is saved without the spaces before and behind it") {
  test::NullUi window;
  const fs::path file = window.config / "presets/spaces.json";
  open_dialog(window, Kind::save);
  save_as(window, "  Soft cloth ", file);
  CHECK(load_preset(file).name == "Soft cloth");
  CHECK(window.preset().name == "Soft cloth");
}

TEST_CASE("cards are gone through by keys; a preset with errors says what is wrong and opens nothing") {
  test::NullUi window;
  fs::create_directories(window.config / "presets");
  test::write_file(window.config / "presets/wrong.json", "{\"tyglab_preset\": 1,\n \"forces\": {\"k_z\": 3}}\n");
  open_dialog(window, Kind::open);
  window.until([&] { return window.typing(); }, "the field to take keys");
  window.type("wrong");
  window.key(GLFW_KEY_ENTER);
  window.frames(2);
  CHECK(window.ui.dialog.kind == Kind::open);
  CHECK(window.drew("k_z"));
  window.key(GLFW_KEY_A, ctrl);
  window.type("zzz");
  window.frames(2);
  CHECK(window.drew("No matches."));
  window.key(GLFW_KEY_A, ctrl);
  window.type("bending springs");
  window.frames(2);
  window.key(GLFW_KEY_DOWN);
  window.key(GLFW_KEY_DOWN);  // beyond the last
  window.key(GLFW_KEY_UP);
  window.key(GLFW_KEY_ENTER);
  window.frames(3);
  CHECK(window.session.document.label == "fold_with_k_b");
}

TEST_CASE("the button of the dialog that opens presets opens the card that is chosen") {
  test::NullUi window;
  open_dialog(window, Kind::open);
  window.until([&] { return window.typing(); }, "the field to take keys");
  window.click("dialog.Open");  // nothing is chosen yet
  window.frames(3);
  CHECK(window.ui.dialog.kind == Kind::open);
  window.click("dialog.find");
  window.type("denim");
  window.frames(2);
  window.click("dialog.Open");
  window.frames(3);
  CHECK(window.ui.dialog.kind == Kind::none);
  CHECK(window.session.document.label == "denim");
}

TEST_CASE("a shipped preset's name typed into the dialog opens it; its constants begin at the top") {
  test::NullUi window;
  const Box top = window.control("constants.integrator");
  window.scroll_to("constants.texture", "constants.k_s.slider");
  window.frames(2);
  CHECK_FALSE(window.sees("constants.integrator"));
  open_dialog(window, Kind::open);
  window.fill("path", "denin");
  window.key(GLFW_KEY_ENTER);
  window.until([&] { return window.typing(); }, "the field to take keys again");
  CHECK(window.ui.dialog.problem.find("Did you mean 'denim'?") != std::string::npos);
  window.type("denim");  // over the wrong name, which is selected
  window.key(GLFW_KEY_ENTER);
  window.frames(3);
  CHECK(window.session.document.label == "denim");
  CHECK(window.ui.dialog.kind == Kind::none);
  CHECK(window.session.document.file.empty());
  CHECK_FALSE(unsaved(window.session));
  CHECK(window.control("constants.integrator").lo == top.lo);
}

TEST_CASE("a wrong file is refused with the reason, where another can be chosen, and nothing changes") {
  test::NullUi window;
  const fs::path wrong = window.config / "wrong.json";
  test::write_file(wrong, "{\"tyglab_preset\": 1,\n \"forces\": {\"k_z\": 3}}\n");
  open_dialog(window, Kind::open);
  window.fill("path", wrong.string());
  window.click("dialog.Open");
  const std::string& problem = window.ui.dialog.problem;
  CHECK(problem.find("k_z") != std::string::npos);
  CHECK(problem.find("wrong.json") != std::string::npos);
  CHECK(problem.find("k_s") != std::string::npos);  // the nearest key
  CHECK(window.drew("k_z"));
  CHECK(window.session.document.label == "hanging");
  CHECK_FALSE(unsaved(window.session));
  window.click("dialog.Cancel");
  CHECK(window.ui.dialog.kind == Kind::none);
}

TEST_CASE("a preset that cannot be written stays unsaved, and the dialog says why") {
  test::NullUi window;
  window.type_value("k_s", "60");
  window.key(GLFW_KEY_S, ctrl);
  save_as(window, "Nowhere", "/proc/nowhere/preset.json");
  CHECK_FALSE(window.ui.dialog.problem.empty());
  CHECK(unsaved(window.session));
  CHECK(window.ui.dialog.kind == Kind::save);
  window.until([&] { return window.typing(); }, "the file's field");
  const std::string file = (window.config.path() / "nowhere.json").string();
  window.type(file);
  CHECK(std::string(window.ui.dialog.name) == "Nowhere");
  CHECK(std::string(window.ui.dialog.path) == file);
}

TEST_CASE("quitting asks while changes are unsaved; Escape stays, Save saves first") {
  test::NullUi window;
  window.type_value("k_s", "66");
  for (const bool by_key : {false, true}) {
    if (by_key) {
      window.key(GLFW_KEY_Q, ctrl);
    } else {
      window.session.request(request::Quit{});  // what the window's close button asks
    }
    window.frames(3);
    CHECK(window.ui.dialog.kind == Kind::unsaved);
    window.key(GLFW_KEY_ESCAPE);
    CHECK(window.ui.dialog.kind == Kind::none);
    CHECK_FALSE(window.session.quit);
  }
  window.key(GLFW_KEY_ESCAPE);
  CHECK(window.ui.dialog.kind == Kind::none);
  window.key(GLFW_KEY_Q, ctrl);
  const fs::path file = window.config / "presets/kept.json";
  window.click("dialog.Save");
  save_as(window, "Kept", file);
  CHECK(window.session.quit);
  CHECK(load_preset(file).k_s == 66);
}

TEST_CASE("copied links begin with the course's page once its address is set") {
  test::NullUi window;
  window.pause();
  window.ui.command("copy_embed_code");
  window.frames(2);
  CHECK(window.said("Set the address of your Tyglab page first"));
  window.find("copy link");
  CHECK(std::string(ImGui::GetClipboardText()) == "#hanging");
  window.find("course page");
  window.fill("path", "example.org");
  window.click("dialog.Keep");
  CHECK(window.drew("An address begins with https:// or http://."));
  window.fill("path", " https://example.org/tyglab/#flag ");
  window.click("dialog.Keep");
  CHECK(window.settings.course_page == "https://example.org/tyglab/");
  window.type_value("k_s", "80");
  window.find("copy link");
  CHECK(std::string(ImGui::GetClipboardText()) == "https://example.org/tyglab/#hanging&k_s=80");
  CHECK(window.said("Link copied."));
  window.find("copy embed code");
  CHECK(std::string(ImGui::GetClipboardText()) ==
        "<iframe width=\"900\" height=\"640\" "
        "src=\"https://example.org/tyglab/?embed#hanging&amp;k_s=80\"></iframe>");
}

}  // namespace tyglab::documents_test
