// `tyglab run` and `render` from the outside: what they write, and that it is the oracle's motion.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "core/io/preset_io.h"
#include "tests/oracle/oracle.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace tyglab::run_test {

namespace fs = std::filesystem;

test::Outcome good(const fs::path& folder, const std::vector<std::string>& arguments) {
  auto outcome = test::tyglab(folder, arguments);
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  return outcome;
}

TEST_CASE("tyglab run denim --precision double --steps 200 equals the oracle's state to 1e-10 m") {
  const test::TemporaryFolder folder;
  good(folder.path(), {"run", "denim", "--precision", "double", "--steps", "200", "--state", "s.csv"});
  oracle::Cloth cloth(load_preset(std::string(test::source_dir) + "/app/presets/denim.json"));
  cloth.advance(200);
  const auto rows = test::lines(test::read_file(folder / "s.csv"));
  REQUIRE(int(rows.size()) == 2 + cloth.rows() * cloth.columns());
  double largest = 0, largest_velocity = 0;
  for (std::size_t n = 2; n < rows.size(); ++n) {
    const auto cells = test::split(rows[n], ',');
    REQUIRE(cells.size() == 8);
    const auto at = [&](std::size_t c) { return std::strtod(cells[c].c_str(), nullptr); };
    const auto& wanted = cloth.at(std::stoi(cells[0]), std::stoi(cells[1]));
    largest = std::max(largest, glm::length(glm::dvec3(at(2), at(3), at(4)) - wanted.x));
    largest_velocity = std::max(largest_velocity, glm::length(glm::dvec3(at(5), at(6), at(7)) - wanted.v));
  }
  CHECK(largest < 1e-10);
  CHECK(largest_velocity < 1e-6);
}

TEST_CASE("--engine auto says what it chose and why, to people and to programs") {
  const test::TemporaryFolder folder;
  const auto outcome = good(folder.path(), {"run", "hanging", "--steps", "5", "--engine", "auto", "--json", "r.json"});
  CHECK(outcome.err.find("--engine auto chose ") != std::string::npos);
  const auto json = nlohmann::json::parse(test::read_file(folder / "r.json"));
  const std::string why = json["engine_choice"]["why"];
  CHECK(outcome.err.find(why) != std::string::npos);
  CHECK(why.starts_with(json["engine"] == "cpu" ? "the CPU engine" : "OpenCL on "));
  good(folder.path(), {"run", "hanging", "--steps", "5", "--json", "r.json"});
  CHECK(nlohmann::json::parse(test::read_file(folder / "r.json"))["engine_choice"].is_null());
}

TEST_CASE("--values writes what can color the cloth, a row per particle") {
  const test::TemporaryFolder folder;
  good(folder.path(), {"run", "hanging", "--seconds", "0.2", "--values", "v.csv", "--state", "s.csv"});
  const auto rows = test::lines(test::read_file(folder / "v.csv")),
             states = test::lines(test::read_file(folder / "s.csv"));
  REQUIRE(rows.size() == 2 + 32 * 32);
  CHECK(rows[0].starts_with("# tyglab values, t = 0.2"));
  CHECK(rows[1] == "i,j,tension [N],strain,speed [m/s],kinetic [J]");
  const auto value = [](const std::string& row, std::size_t column) {
    return std::strtod(test::split(row, ',')[column].c_str(), nullptr);
  };
  CHECK(value(rows[2], 2) > 0.01);  // the pinned corner holds the cloth and rests
  CHECK(value(rows[2], 4) == 0);
  CHECK(value(rows[700], 5) == doctest::Approx(0.0003 / 2 * std::pow(value(rows[700], 4), 2)).epsilon(1e-5));
  const auto weight = good(folder.path(), {"run", "one_weight", "--steps", "9", "--values", "-"});
  CHECK(test::lines(weight.out)[1] == "i,j,speed [m/s],kinetic [J]");
}

TEST_CASE("render --color adds colors and a legend, and refuses what it cannot show") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> same{"render", "hanging", "--seconds", "0.2", "--size", "320x180"};
  const auto picture = [&](std::vector<std::string> more) {
    std::vector<std::string> all = same;
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), {"--png", "p.png"});
    good(folder.path(), all);
    return test::read_file(folder / "p.png");
  };
  const std::string plain = picture({}), tension = picture({"--color", "tension"}),
                    strain = picture({"--color", "strain"});
  CHECK(plain != tension);
  CHECK(tension != strain);
  CHECK(picture({}) == plain);
  auto refused = same;
  refused.insert(refused.end(), {"--color", "distance", "--png", "q.png"});
  CHECK(test::tyglab(folder.path(), refused).code == 2);
}

TEST_CASE("a run twice writes the same bytes, and from any folder") {
  const test::TemporaryFolder a, b;
  for (const auto* folder : {&a, &b}) {
    good(folder->path(), {"run", "flag", "--steps", "150", "--state", "s.csv", "--series", "t.csv", "--pc2", "c.pc2"});
  }
  for (const char* file : {"s.csv", "t.csv", "c.pc2"}) CHECK(test::read_file(a / file) == test::read_file(b / file));
}

TEST_CASE("--obj and --pc2 write a frame for each 1/fps, of the same positions") {
  const test::TemporaryFolder folder;
  good(folder.path(), {"run", "hanging", "--seconds", "0.4", "--fps", "10", "--obj", "frames", "--pc2", "c.pc2"});
  int frames = 0;
  for (const auto& entry : fs::directory_iterator(folder / "frames")) {
    frames += entry.path().extension() == ".obj" ? 1 : 0;
  }
  CHECK(frames == 5);
  const auto shorter = good(folder.path(), {"run", "hanging", "--seconds", "0.2", "--fps", "10", "--obj", "frames"});
  CHECK(shorter.err.find("frames also holds 2 frames of an earlier sequence of hanging; remove them") !=
        std::string::npos);
  const std::string cache = test::read_file(folder / "c.pc2");
  const Preset preset = load_preset(std::string(test::source_dir) + "/app/presets/hanging.json");
  const std::size_t count = std::size_t(preset.rows) * preset.columns;
  REQUIRE(cache.size() == 32 + 5 * count * 12);
  std::int32_t samples = 0;
  std::memcpy(&samples, cache.data() + 28, 4);
  CHECK(samples == 5);
  // The last frame's first free particle, in both files.
  float x[3];
  std::memcpy(x, cache.data() + 32 + (4 * count + 1) * 12, 12);
  std::size_t p = 0;
  for (const std::string& line : test::lines(test::read_file(folder / "frames" / "hanging_0004.obj"))) {
    if (!line.starts_with("v ") || p++ != 1) continue;
    const auto cells = test::split(line, ' ');
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::strtof(cells[c + 1].c_str(), nullptr) == x[c]);
  }
  CHECK(p == count);
}

TEST_CASE("--json tells programs what was done, and - writes it to standard output alone") {
  const test::TemporaryFolder folder;
  const auto outcome = good(folder.path(), {"run", "one_weight", "--steps", "10", "--json", "-"});
  CHECK(outcome.out.starts_with("{"));
  CHECK(outcome.out.find("\"steps\": 10") != std::string::npos);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("- is standard output for every file, and gives the same bytes") {
  const test::TemporaryFolder folder;
  for (const char* option : {"--state", "--series", "--pc2"}) {
    CAPTURE(std::string(option));
    const auto streamed = good(folder.path(), {"run", "hanging", "--seconds", "0.1", option, "-"});
    good(folder.path(), {"run", "hanging", "--seconds", "0.1", option, "file"});
    CHECK(streamed.out == test::read_file(folder / "file"));
    CHECK(streamed.err.find("Wrote standard output") != std::string::npos);
  }
  const auto picture = good(folder.path(), {"render", "hanging", "--seconds", "0", "--size", "64x48", "--png", "-"});
  CHECK(picture.out.starts_with("\x89PNG"));
  CHECK_FALSE(fs::exists(folder / "-"));
}

TEST_CASE("docs/presets.md shows the beginning of the state that its command writes") {
  const std::string page = test::read_file(std::string(test::source_dir) + "/docs/presets.md");
  const std::string command = "```\ntyglab run hanging --seconds 2 --state F.csv\n```";
  REQUIRE(page.find(command) != std::string::npos);
  const std::size_t begin = page.find("# tyglab state, ", page.find(command)), end = page.find("…", begin);
  REQUIRE(end != std::string::npos);
  const test::TemporaryFolder folder;
  good(folder.path(), {"run", "hanging", "--seconds", "2", "--state", "F.csv"});
  CHECK(test::read_file(folder.path() / "F.csv").starts_with(page.substr(begin, end - begin)));
}

TEST_CASE("run and presets check say in one line that the preset's picture is missing") {
  const test::TemporaryFolder folder;
  Preset preset;
  preset.texture = "gone.png";
  test::write_file(folder / "a.json", preset_to_json(preset));
  for (const std::vector<std::string>& call : {std::vector<std::string>{"run", "a.json", "--steps", "1"},
                                               std::vector<std::string>{"presets", "check", "a.json"}}) {
    const auto outcome = good(folder.path(), call);
    CHECK(test::lines(outcome.err).size() == 1);
    CHECK(outcome.err.find("gone.png") != std::string::npos);
  }
}

TEST_CASE("without a display every start gets a folder of its own, and nothing is replaced") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "tyglab-out", "not a folder");
  for (const char* made : {"tyglab-out-2", "tyglab-out-3"}) {
    const auto outcome = good(folder.path(), {"one_weight", "--frames", "2"});
    CHECK(outcome.err.find(made) != std::string::npos);
    CHECK(fs::exists(folder / made / "one_weight_0004.png"));
  }
  CHECK(test::read_file(folder / "tyglab-out") == "not a folder");
}

TEST_CASE("numbers are read as people type them") {
  const test::TemporaryFolder folder;
  CHECK(good(folder.path(), {"run", "one_weight", "--steps", "1e3"}).out.find(": 1000 steps") != std::string::npos);
  CHECK(good(folder.path(), {"run", "one_weight", "--steps", "010"}).out.find(": 10 steps") != std::string::npos);
  CHECK(good(folder.path(), {"run", "one_weight", "--steps", "1"}).out.find(": 1 step to") != std::string::npos);
}

TEST_CASE("--set and the short forms reach the simulation") {
  const test::TemporaryFolder folder;
  const auto outcome =
      good(folder.path(), {"run", "hanging", "--set", "rows=5", "--set", "columns=4", "--integrator", "euler", "--dt",
                           "0.0005", "--precision", "double", "--steps", "10", "--json", "-", "--state", "s.csv"});
  for (const char* part :
       {"\"rows\": 5", "\"columns\": 4", "\"euler\"", "\"dt\": 0.0005", "\"double\"", "\"t\": 0.005"}) {
    CHECK_MESSAGE(outcome.out.find(part) != std::string::npos, part);
  }
  CHECK(test::lines(test::read_file(folder / "s.csv")).size() == 22);
}

TEST_CASE("presets show is a preset that runs the same") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "copy.json", good(folder.path(), {"presets", "show", "sphere"}).out);
  good(folder.path(), {"run", "copy.json", "--steps", "50", "--state", "a.csv"});
  good(folder.path(), {"run", "sphere", "--steps", "50", "--state", "b.csv"});
  CHECK(test::read_file(folder / "a.csv") == test::read_file(folder / "b.csv"));
}

TEST_CASE("no progress bar and no color codes when output is not a terminal") {
  const test::TemporaryFolder folder;
  const auto outcome = good(folder.path(), {"run", "hanging", "--seconds", "1"});
  for (const std::string* text : {&outcome.out, &outcome.err}) {
    CHECK(text->find('\r') == std::string::npos);
    CHECK(text->find('\x1b') == std::string::npos);
  }
  CHECK(outcome.err.empty());
}

/// Width and height of a PNG file.
std::pair<int, int> png_size(const fs::path& file) {
  const std::string bytes = test::read_file(file);
  REQUIRE(bytes.size() > 32);
  CHECK(bytes.starts_with("\x89PNG\r\n\x1a\n"));
  const auto at = [&](std::size_t n) { return int(static_cast<unsigned char>(bytes[n])); };
  const auto number = [&](std::size_t n) { return at(n) << 24 | at(n + 1) << 16 | at(n + 2) << 8 | at(n + 3); };
  return {number(16), number(20)};
}

TEST_CASE("render draws every view without a display, each different") {
  const test::TemporaryFolder folder;
  std::vector<std::string> pictures;
  for (const char* view : {"1", "2", "3", "4", "5"}) {
    const fs::path file = folder / (std::string(view) + ".png");
    good(folder.path(), {"render", "hanging", "--seconds", "0.3", "--view", view, "--size", "320x180", "--png", file});
    CHECK(png_size(file) == std::pair{320, 180});
    pictures.push_back(test::read_file(file));
  }
  // View 3 is view 1 as long as nothing is torn.
  CHECK(pictures[0] == pictures[2]);
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 3}, {0, 4}, {1, 3}, {1, 4}, {3, 4}}) {
    CHECK(pictures[std::size_t(a)] != pictures[std::size_t(b)]);
  }
}

TEST_CASE("render writes a sequence") {
  const test::TemporaryFolder folder;
  good(folder.path(), {"render", "flag", "--seconds", "0.2", "--fps", "10", "--size", "64x48", "--png", "film"});
  int count = 0;
  for (const auto& entry : fs::directory_iterator(folder / "film")) {
    CHECK(png_size(entry.path()) == std::pair{64, 48});
    ++count;
  }
  CHECK(count == 3);
  CHECK(fs::exists(folder / "film" / "flag_0002.png"));
  const auto shorter =
      good(folder.path(), {"render", "flag", "--seconds", "0.1", "--fps", "10", "--size", "64x48", "--png", "film"});
  CHECK(shorter.err.find("film also holds 1 frame of an earlier sequence of flag; remove it") != std::string::npos);
}

TEST_CASE("--ledger writes where the energy goes, on the rows of --series, and --json what it says at the end") {
  const test::TemporaryFolder folder;
  const auto outcome = good(folder.path(), {"run", "flag", "--seconds", "0.4", "--fps", "10", "--ledger", "l.csv",
                                            "--series", "s.csv", "--json", "-"});
  const auto rows = test::lines(test::read_file(folder / "l.csv"));
  REQUIRE(rows.size() == 2 + 5);
  CHECK(rows[1].rfind("t,kinetic [J],stretch [J],", 0) == 0);
  CHECK(test::split(rows[1], ',').size() == test::split(rows[6], ',').size());
  CHECK(test::lines(test::read_file(folder / "s.csv")).size() == rows.size());
  CHECK(std::abs(std::strtod(test::split(rows[6], ',').back().c_str(), nullptr)) < 0.01);
  CHECK(outcome.out.find("\"unexplained_J\":") != std::string::npos);
}

TEST_CASE("energy that errors of the method have added is said, with the ratio") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> free_cloth{"run",       "hanging", "--set",  "rows=10",   "--set", "columns=10",
                                            "--set",     "k_d=0",   "--set",  "pins=none", "--set", "k_s=1e4",
                                            "--seconds", "2",       "--json", "r.json"};
  auto midpoint = free_cloth, verlet = free_cloth;
  midpoint.insert(midpoint.end(), {"--integrator", "implicit_midpoint", "--dt", "0.01"});
  verlet.insert(verlet.end(), {"--dt", "9e-5"});
  const auto wrong = test::tyglab(folder.path(), midpoint);
  CHECK(wrong.code == 0);
  CHECK(wrong.err.find("times the energy the scene can supply") != std::string::npos);
  CHECK(nlohmann::json::parse(test::read_file(folder.path() / "r.json"))["energy_over_given"] > 100);
  const auto right = test::tyglab(folder.path(), verlet);
  CHECK(right.err.find("times the energy the scene can supply") == std::string::npos);
  CHECK(nlohmann::json::parse(test::read_file(folder.path() / "r.json"))["energy_over_given"] <= 1.02);
}

TEST_CASE("a cloth that has passed through itself is said, with the number of crossing triangles") {
  const test::TemporaryFolder folder;
  const auto run = [&](const std::string& preset) {
    return good(folder.path(), {"run", preset, "--seconds", "1", "--json", "r.json"}).err;
  };
  const auto crossings = [&] { return nlohmann::json::parse(test::read_file(folder.path() / "r.json"))["crossings"]; };
  const std::string twisted = run("twist");
  REQUIRE(crossings() > 1);
  CHECK(twisted.find("The cloth passes through itself: " + std::to_string(crossings().get<int>()) +
                     " pairs of triangles cross.") != std::string::npos);
  CHECK(run("hanging").find("through itself") == std::string::npos);
  CHECK(crossings() == 0);
  test::tyglab(folder.path(), {"run", "explodes", "--json", "r.json"});
  CHECK(crossings().is_null());
}

TEST_CASE("a cloth whose springs tear has diverged when its motion has more energy than anything gave it") {
  const test::TemporaryFolder folder;
  const auto run = test::tyglab(folder.path(), {"run", "hanging", "--seconds", "1", "--dt", "0.001", "--set",
                                                "F_max=10", "--set", "k_d=0.005", "--set", "m=3e-5", "--set", "k_s=1"});
  CHECK(run.code == 4);
  CHECK(run.err.find("times the energy the scene can supply") != std::string::npos);
}

TEST_CASE("130: two signals at once are one wish, and what was asked for is written") {
  const test::TemporaryFolder folder;
  const std::string script =
      "\"$0\" run denim --seconds 100000 --state s.csv --json r.json --series t.csv & "
      "until [ -e t.csv.incomplete ]; do sleep 0.1; done; sleep 0.5; kill -INT $!; kill -TERM $!; wait $!";
  const auto ended = test::run(folder.path(), {"sh", "-c", script, test::binary});
  CHECK(ended.code == 130);
  CHECK(std::filesystem::exists(folder.path() / "s.csv"));
  CHECK(std::filesystem::exists(folder.path() / "r.json"));
}

TEST_CASE("--dt auto gives up where a smaller dt does not help, and says so once") {
  const test::TemporaryFolder folder;
  const auto run = test::tyglab(
      folder.path(), {"run", "hanging", "--seconds", "2", "--set", "rows=10", "--set", "columns=10", "--set", "k_d=0",
                      "--set", "pins=none", "--integrator", "implicit_midpoint", "--set", "k_s=1e4", "--dt", "auto"});
  CHECK(run.code == 0);
  const std::size_t said = run.err.find("has not kept");
  REQUIRE(said != std::string::npos);
  CHECK(run.err.find("has not kept", said + 1) == std::string::npos);
}

TEST_CASE("--tolerance chooses a dt whose steps end at the time asked for") {
  const test::TemporaryFolder folder;
  const auto run =
      test::tyglab(folder.path(), {"run", "hanging", "--seconds", "1", "--tolerance", "1e-5", "--json", "r.json"});
  REQUIRE(run.code == 0);
  CHECK(nlohmann::json::parse(test::read_file(folder.path() / "r.json"))["t"] == doctest::Approx(1).epsilon(1e-12));
}

TEST_CASE("--dt auto takes a stable dt, halves it where energy is made, and ends at the time asked for") {
  const test::TemporaryFolder folder;
  auto outcome = good(folder.path(), {"run", "explodes", "--integrator", "verlet", "--set", "k_s=20000", "--dt", "auto",
                                      "--seconds", "0.5", "--json", "-"});
  CHECK(outcome.out.find("\"status\": \"done\"") != std::string::npos);
  // A weight on its spring, where semi-implicit Euler's energy swings by more than is allowed.
  outcome = good(folder.path(), {"run", "one_weight", "--integrator", "semi_implicit_euler", "--dt", "auto", "--set",
                                 "k=400", "--seconds", "5", "--series", "s.csv", "--fps", "10"});
  CHECK(outcome.err.find("was adding energy; dt is") != std::string::npos);
  const auto rows = test::lines(test::read_file(folder / "s.csv"));
  REQUIRE(rows.size() == 2 + 51);
  for (std::size_t n = 2; n < rows.size(); ++n)
    CHECK(std::strtod(rows[n].c_str(), nullptr) == doctest::Approx(0.1 * double(n - 2)).epsilon(0.05));
  outcome = test::tyglab(folder.path(), {"run", "hanging", "--integrator", "euler", "--set", "k_d=0", "--dt", "auto"});
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("no stable dt") != std::string::npos);
}

}  // namespace tyglab::run_test
