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
  window.find("film");
  const test::TemporaryFolder folder;
  window.fill("seconds", "0.2");
  window.fill("path", (folder / "film").string());
  window.click("dialog.Export");
  REQUIRE(window.ui.film);
  CHECK(std::filesystem::is_directory(folder / "film"));
  const double begun = window.t();
  std::vector<double> taken;
  std::string last;
  for (int n = 0; n < 200 && window.ui.film; ++n) {
    const auto elapsed = direct_film(window.ui);
    if (!elapsed) break;
    act_on_events(window.ui, *elapsed, 1.0 / 60);
    if (window.ui.picture) taken.push_back(window.t()), last = window.ui.picture->file.filename().string();
    window.ui.picture.reset();
  }
  REQUIRE(taken.size() == 5);
  CHECK(last == "hanging_0004.png");
  for (std::size_t n = 0; n < taken.size(); ++n)
    CHECK(std::abs(taken[n] - begun - 0.04 * double(n)) <= 1.01 * window.preset().dt);
  CHECK(window.said("Exported 5 images to "));
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
