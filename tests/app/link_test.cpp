// Links: an experiment's constants at the end of a page's address.
#include <doctest/doctest.h>

#include <set>

#include "app/base/files.h"
#include "app/base/text.h"
#include "core/io/preset_io.h"
#include "core/simulation.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace tyglab::link_test {

/// What a link brings back; a description stays with its shipped preset.
Preset there_and_back(const Preset& preset, const std::string& label) {
  const std::string link = link_to(preset, label);
  CAPTURE(link);
  CHECK(link.find_first_of(" \"<>{}|\\^`") == std::string::npos);  // as addresses must
  Preset back = linked_preset(read_link("https://example.org/page/" + link));
  back.description = preset.description;
  return back;
}

std::string problem_of(const std::string& link) {
  try {
    linked_preset(read_link(link));
  } catch (const PresetError& error) {
    return error.what();
  }
  return {};
}

TEST_CASE("a link brings back every constant of every shipped preset, from its own and from another's") {
  for (const std::string& name : shipped_presets()) {
    CAPTURE(name);
    const Preset preset = read_preset(find_preset(name).file);
    CHECK(link_to(preset, name) == "#" + name);
    CHECK(there_and_back(preset, name) == preset);
    CHECK(there_and_back(preset, "my own") == preset);
  }
}

TEST_CASE("a link brings back what was changed, whatever its name") {
  Preset preset = read_preset(find_preset("sphere").file);
  preset.name = "Å \"quoted\" 100 % & more = # it\n[1]";
  preset.k_s = 1.0 / 3, preset.rows = 17, preset.W = {0, -1e-7, 0.02}, preset.gust = 0.4;
  preset.pins = {Pins::Mode::list, {{0, 0}, {16, 3}}};
  preset.bodies.push_back({.shape = Body::Shape::plane, .y = -0.25, .restitution = 0.5});
  preset.integrator = "rk4", preset.precision = Precision::double_, preset.texture = "linen.png", preset.mode = 3;
  CHECK(there_and_back(preset, "sphere") == preset);
  preset.name = "7", preset.bodies.clear();
  CHECK(there_and_back(preset, "sphere") == preset);
}

TEST_CASE("a link has no digits that only sums have left, and keeps those that were meant") {
  Preset preset = read_preset(find_preset("hanging").file);
  preset.L = 0.1 + 0.2, preset.k_s = 1.0 / 3, preset.x_0 = {0.23249999999999998, 0, 0};
  const std::string link = link_to(preset, "hanging");
  CHECK(link.find("L=0.3&") != std::string::npos);
  CHECK(link.find("k_s=0.3333333333333333") != std::string::npos);
  CHECK(link.find("0.2325") != std::string::npos);
}

TEST_CASE("an image of one's own is not in a link") {
  Preset preset = read_preset(find_preset("denim").file);
  preset.texture = "/home/somebody/image.png";
  CHECK(link_to(preset, "denim") == "#denim");
}

TEST_CASE("a whole address, its end and no link at all are read") {
  CHECK(linked_preset(read_link("https://example.org/tyglab/?embed#flag&k_s=80")).k_s == 80);
  CHECK(linked_preset(read_link("#flag&W=%5B0%2C0%2c0.01%5D")).W.z == 0.01);
  CHECK(linked_preset(read_link("#k_s=80")) == linked_preset(read_link("#hanging&k_s=80")));
  CHECK(read_link("HTTPS://example.org/?embed&preset=flag&panels=0").name == "flag");
  CHECK(read_link("https://example.org/?preset=sphere").name == "sphere");
  // What stands before the # counts where the link names no preset of its own.
  CHECK(read_link("https://example.org/?embed&preset=flag#k_s=80").name == "flag");
  CHECK(read_link("https://example.org/?embed&preset=flag#k_s=80").settings == std::vector<std::string>{"k_s=80"});
  CHECK(read_link("https://example.org/?embed&preset=flag#").name == "flag");
  CHECK(read_link("https://example.org/?preset=flag&report#sphere&k_s=80").name == "sphere");
  CHECK(read_link("https://example.org/?lab=03_stiffness&report#k_s=80").name == "hanging");
  CHECK(problem_of("https://example.org/?embed&preset=flag&k_s=300").find("has no #") != std::string::npos);
  CHECK(is_link("#flag"));
  CHECK(is_link("Http://a"));
  CHECK_FALSE(is_link("flag"));
  CHECK(is_link("ftp://a"));
  CHECK_FALSE(is_link("http"));
  CHECK_FALSE(is_link("my#file.json"));
}

TEST_CASE("an address without an experiment is refused, with what to do instead") {
  for (const char* address : {"https://example.org/my_preset.json", "https://example.org/my_preset.json?raw=1#k_s=80",
                              "https://example.org/file?id=3", "ftp://example.org/my_preset.json",
                              "https://example.org/", "https://example.org/#", "https://example.org/?embed",
                              "https://example.org/hanging&k_s=300", "https://example.org/%23flag"}) {
    CAPTURE(address);
    CHECK(problem_of(address).find("download the file first") != std::string::npos);
  }
  CHECK(problem_of("file:///home/a/my%20own.json").find("by its path: '/home/a/my own.json'") != std::string::npos);
  CHECK(problem_of("file://").find("by its path") != std::string::npos);
}

/// The links in a text, each as it would be copied.
std::vector<std::string> links_in(const std::string& text) {
  std::vector<std::string> links;
  for (std::size_t at = text.find('#'); at != std::string::npos; at = text.find('#', at + 1)) {
    const std::string link = text.substr(at, text.find_first_of("` '\"\n)", at) - at);
    if (link.find('=') != std::string::npos) links.push_back(link);
  }
  return links;
}

TEST_CASE("the links that pages and messages give as examples last") {
  std::string text = problem_of("#nothing").substr(20) + "\n" + problem_of("https://example.org/");
  const std::filesystem::path docs = std::filesystem::path(test::source_dir) / "docs";
  for (const auto& entry : std::filesystem::directory_iterator(docs))
    if (entry.path().extension() == ".md") text += "\n" + test::read_file(entry.path());
  for (const char* page : {"README.md", "CHANGELOG.md"}) text += "\n" + test::read_file(docs / ".." / page);
  const std::vector<std::string> links = links_in(text);
  CHECK(links.size() >= 5);
  for (const std::string& link : std::set<std::string>(links.begin(), links.end())) {
    CAPTURE(link);
    Simulation simulation(linked_preset(read_link(link)));
    simulation.advance(5000);
    CHECK_FALSE(simulation.divergence());
  }
}

TEST_CASE("a body's JSON stands in a link without spaces, and of a long link the beginning is quoted") {
  Preset preset = read_preset(find_preset("hanging").file);
  preset.bodies.push_back({.shape = Body::Shape::plane, .y = -0.25});
  const std::string link = link_to(preset, "hanging");
  CHECK(link.find("%20") == std::string::npos);
  CHECK(link.find("bodies=[%7B%22shape%22:%22plane%22") != std::string::npos);
  const std::string much(40000, '1');
  for (const std::string& long_link :
       {"#" + much, "#hanging&" + much, "#hanging&k_s=" + much, "#hanging&k_s=." + much + "x",
        "#hanging&" + much + "=3", "#hanging&integrator=" + much, "#hanging&name=" + much, "#hanging&bodies=" + much,
        "#hanging&bodies=[{\"" + much + "\":1}]", "#hanging&texture=" + much, "#hanging&" + much + "=%",
        "https://example.org/" + much, "https://example.org/?preset=" + much, "https://example.org/?lab=" + much})
    CHECK(problem_of(long_link).size() < 900);
  for (const std::string& word : {much, much + ".json"})
    CHECK_THROWS_WITH_AS(find_preset(word), doctest::Contains("…"), PresetError);
}

TEST_CASE("what is wrong with a link is named") {
  CHECK(problem_of("#nothing").find("names no shipped preset: 'nothing'") != std::string::npos);
  CHECK(problem_of("#flag&k_s").find("not KEY=VALUE: 'k_s'") != std::string::npos);
  CHECK(problem_of("https://a.b/?embed&lab=03_stiffness").find("tyglab --lab 03_stiffness") != std::string::npos);
  CHECK(problem_of("#flag&=3").find("not KEY=VALUE: '=3'") != std::string::npos);
  CHECK(problem_of("https://a.b/?preset=nothing").find("names no shipped preset: 'nothing'") != std::string::npos);
  CHECK(problem_of("https://a.b/?preset=nothing#k_s=3").find("names no shipped preset: 'nothing'") !=
        std::string::npos);
  CHECK(problem_of("#flag&k_s=%4").find("hexadecimal") != std::string::npos);
  CHECK(problem_of("#flag&k_s=%zz").find("hexadecimal") != std::string::npos);
  CHECK(problem_of("#flag&k_s=-1").find("k_s=-1") != std::string::npos);
  CHECK(problem_of("#").find("names neither a preset nor a constant") != std::string::npos);
  CHECK(problem_of("#flag&k_s=1&k_s=2").find("sets 'k_s' twice") != std::string::npos);
  CHECK(problem_of("#k_s=1&W=[0,0,1]&k%5Fs=2").find("sets 'k_s' twice") != std::string::npos);
  CHECK(problem_of("#flag&k_q=1").find("unknown key") != std::string::npos);
  CHECK(problem_of("#flag&texture=/etc/passwd").find("not a shipped one") != std::string::npos);
}

}  // namespace tyglab::link_test
