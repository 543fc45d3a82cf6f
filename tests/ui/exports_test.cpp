// What the window writes to files: tables of particles and of the map, and the cloth as a mesh.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/base/glfw_keys.h"
#include "app/ui/frame/frame.h"
#include "tests/ui/null_ui.h"

namespace tyglab::exports_test {

void fall_and_pause(test::NullUi& window) {
  window.until([&] { return window.t() > 0.3; }, "the cloth to fall a little");
  window.pause();
}

void begin_film(test::NullUi& window, const std::filesystem::path& folder, std::string_view seconds) {
  window.find("film");
  window.fill("seconds", seconds);
  window.fill("path", folder.string());
  window.click(window.middle("dialog.Export"));
  REQUIRE((window.ui.film || window.said("Exported")));
}

std::vector<double> numbers(std::string_view row, char separator = ',') {
  std::vector<double> out;
  for (const std::string& word : test::split(row, separator)) out.push_back(std::stod(word));
  return out;
}

TEST_CASE("every particle's values are written as CSV from the palette") {
  test::NullUi window;
  fall_and_pause(window);
  window.find("particle's values");
  const auto rows = test::lines(test::read_file(window.write_export("values.csv")));
  REQUIRE(rows.size() == 2 + 32 * 32);
  CHECK(rows[1] == "i,j,tension [N],strain,speed [m/s],kinetic [J]");
  const std::vector<double> pinned = numbers(rows[2]);
  CHECK(pinned[2] > 0);   // the pinned corner holds …
  CHECK(pinned[4] == 0);  // … and rests
}

TEST_CASE("Ctrl+E writes the cloth as OBJ, and the palette the state, as the cloth stands") {
  test::NullUi window;
  fall_and_pause(window);
  window.key(GLFW_KEY_E, GLFW_MOD_CONTROL);
  const auto mesh = test::lines(test::read_file(window.write_export("cloth.obj")));
  std::map<std::string, int> count;
  std::vector<std::string> vertices;
  for (const std::string& line : mesh) {
    const std::string word = test::split(line, ' ')[0];
    ++count[word];
    if (word == "v") vertices.push_back(line.substr(2));
  }
  CHECK(count["v"] == 1024);
  CHECK(count["vt"] == 1024);
  CHECK(count["vn"] == 1024);
  CHECK(count["f"] == 2 * 31 * 31);
  window.find("export state");
  const auto state = test::lines(test::read_file(window.write_export("state.csv")));
  const std::size_t t = state[0].find("t = ");
  REQUIRE(t != std::string::npos);
  CHECK(std::abs(std::stod(state[0].substr(t + 4)) - window.t()) < 1e-6);
  REQUIRE(state.size() == 2 + 1024);
  const std::vector<double> corner = numbers(state.back()), meshed = numbers(vertices.back(), ' ');
  for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(corner[2 + k] - meshed[k]) < 1e-6);
}

TEST_CASE("a film of the window is found by its other names, and has 25 images for each second of the motion") {
  test::NullUi window;
  fall_and_pause(window);
  for (const char* words : {"film", "video", "record"}) {
    window.find(words);
    window.frames(2);
    CHECK(window.ui.dialog.kind == Dialog::Kind::film);
    window.key(GLFW_KEY_ESCAPE);
    window.frames(2);
  }
  const test::TemporaryFolder folder;
  const double begun = window.t();
  std::vector<double> taken;
  std::string last;
  window.on_picture = [&](const PictureOrder& order) {
    taken.push_back(window.t()), last = order.file.filename().string();
  };
  begin_film(window, folder / "film", "0.2");
  CHECK(std::filesystem::is_directory(folder / "film"));
  window.until([&] { return !window.ui.film; }, "the end of the film");
  REQUIRE(taken.size() == 5);
  CHECK(last == "hanging_0004.png");
  for (std::size_t n = 0; n < taken.size(); ++n)
    CHECK(std::abs(taken[n] - begun - 0.04 * double(n)) <= 1.01 * window.preset().dt);
  CHECK(window.said("Exported 5 images to "));
}

TEST_CASE("the dialog says how fast a film plays and which command joins its images") {
  test::NullUi window;
  window.find("film");
  window.frames(3);
  CHECK(window.drew("25 images per second of playback"));
  CHECK(window.drew("ffmpeg -framerate 25 -i hanging_%04d.png -pix_fmt yuv420p film.mp4"));
}

TEST_CASE("a click on its button ends a film, whichever frames are images, and cuts nothing") {
  for (const double speed : {1.0, 0.01})  // slowly, several images are of one state
    for (int after = 0; after < 4; ++after)
      for (int held = 1; held < 5; ++held) {
        CAPTURE(speed);
        CAPTURE(after);
        CAPTURE(held);
        const test::TemporaryFolder folder;
        test::NullUi window;
        window.session.pacing.speed = speed;
        begin_film(window, folder / "film", "60");
        window.until([&] { return window.ui.film->frame > 3; }, "a few images");
        const Box* button = window.ui.placing.find("stop_film");
        REQUIRE(button != nullptr);
        window.move((button->lo + button->hi) / 2.f);
        window.frames(after);
        window.input.on_button(GLFW_MOUSE_BUTTON_LEFT, GLFW_PRESS, 0, window.ui.now);
        window.frames(held);
        window.input.on_button(GLFW_MOUSE_BUTTON_LEFT, GLFW_RELEASE, 0, window.ui.now);
        window.frames(6);
        CHECK_FALSE(window.ui.film);
        CHECK(window.said("Exported "));
        CHECK(window.session.counts.touches == 0);
      }
}

TEST_CASE("Escape ends a film before anything else") {
  const test::TemporaryFolder folder;
  test::NullUi window;
  window.key(GLFW_KEY_F5);
  begin_film(window, folder / "film", "60");
  window.frames(10);
  REQUIRE(window.ui.film);
  window.key(GLFW_KEY_ESCAPE);
  window.frames(3);
  CHECK_FALSE(window.ui.film);
  CHECK(window.ui.presenting);
}

TEST_CASE("a folder that is not there keeps the dialog, the path and the keyboard") {
  test::NullUi window;
  window.pause();
  const std::string nowhere = (window.config / "nowhere" / "cloth").string(),
                    there = (window.config / "cloth").string();
  for (const auto kind : {Dialog::Kind::write_export, Dialog::Kind::picture}) {
    const bool mesh = kind == Dialog::Kind::write_export;
    const std::string ending = mesh ? ".obj" : ".png";
    CAPTURE(ending);
    std::optional<PictureOrder> ordered;
    window.on_picture = [&](const PictureOrder& order) { ordered = order; };
    mesh ? window.key(GLFW_KEY_E, GLFW_MOD_CONTROL) : window.key(GLFW_KEY_P, GLFW_MOD_CONTROL | GLFW_MOD_SHIFT);
    window.until([&] { return window.ui.dialog.kind == kind && window.typing(); }, "the dialog");
    window.type(nowhere + ending);  // in place of what is proposed
    CHECK(window.ui.dialog.path == nowhere + ending);
    window.key(GLFW_KEY_ENTER);
    window.frames(4);
    CHECK(window.ui.dialog.kind == kind);
    CHECK(window.ui.dialog.path == nowhere + ending);
    CHECK_FALSE(window.ui.dialog.problem.empty());
    CHECK_FALSE(ordered);
    REQUIRE(window.typing());
    window.type(there + ending);
    CHECK(window.ui.dialog.path == there + ending);
    window.key(GLFW_KEY_ENTER);
    window.until([&] { return window.ui.dialog.kind == Dialog::Kind::none; }, "the dialog to close");
    window.frames(3);
    CHECK((mesh ? std::filesystem::exists(there + ending) : ordered && ordered->file == there + ending));
  }
}

TEST_CASE("a mass on a spring is no mesh: that is said, and no dialog opens") {
  test::NullUi window({.preset = "one_weight"});
  window.key(GLFW_KEY_E, GLFW_MOD_CONTROL);
  window.frames(2);
  CHECK(window.said("mass on a spring"));
  CHECK(window.ui.dialog.kind == Dialog::Kind::none);
}

TEST_CASE("the map is written as CSV, a row for every run") {
  test::NullUi window({.preset = "one_weight"});
  window.pause();  // while nothing moves the frames leave the processors to the map
  window.key(GLFW_KEY_M);
  const std::size_t all = MapWatch::columns * MapWatch::rows;
  window.until([&] { return window.session.studies.map.findings().value_or(MapFindings{}).cells.size() == all; },
               "the map");
  window.click("plots.csv_map");
  const auto rows = test::lines(test::read_file(window.write_export("map.csv")));
  REQUIRE(rows.size() == 2 + all);
  CHECK(rows[1] == "k [N/m],dt [s],outcome,t [s],energy error,dt by theory [s]");
}

}  // namespace tyglab::exports_test
