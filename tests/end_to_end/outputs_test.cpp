// The files of the commands, whatever ends them: an older good one stands until a new one is whole.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "core/io/preset_io.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace tyglab::outputs_test {

namespace fs = std::filesystem;

/// Arguments of a run that writes each kind of file, but for how long it is.
std::vector<std::string> run_of(std::vector<std::string> more) {
  std::vector<std::string> all{"run",      "hanging", "--state", "s.csv", "--series", "t.csv",
                               "--ledger", "l.csv",   "--pc2",   "c.pc2", "--values", "v.csv"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

constexpr std::array<const char*, 5> moments_and_histories{"s.csv", "v.csv", "t.csv", "l.csv", "c.pc2"};
constexpr std::array<const char*, 3> histories{"t.csv", "l.csv", "c.pc2"};

void put_older(const fs::path& folder) {
  for (const char* name : moments_and_histories) test::write_file(folder / name, std::string("older ") + name);
}

bool is_older(const fs::path& folder, const std::string& name) {
  return test::read_file(folder / name) == "older " + name;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Whether it is a series of whole rows, at least that many.
void check_series(const fs::path& file, std::size_t least) {
  const std::string text = test::read_file(file);
  CHECK(text.ends_with('\n'));
  const auto rows = test::lines(text);
  REQUIRE(rows.size() >= 2 + least);
  const auto columns = test::split(rows[1], ',').size();
  for (std::size_t n = 2; n < rows.size(); ++n) CHECK(test::split(rows[n], ',').size() == columns);
}

TEST_CASE("a run that is killed leaves every older file, or the new one, and what it had beside them") {
  const test::TemporaryFolder folder, whole;
  // Short enough that some kills come after the end.
  const std::vector<std::string> call = run_of({"--steps", "300", "--series-every", "1", "--fps", "1000"});
  REQUIRE(test::tyglab(whole.path(), call).code == 0);
  std::mt19937 random(17);
  std::uniform_real_distribution<double> moment(0.005, 0.6);
  int killed = 0;
  for (int n = 0; n < 40; ++n) {
    put_older(folder.path());
    const auto outcome = test::tyglab_interrupted(folder.path(), call, moment(random), SIGKILL);
    killed += outcome.code != 0;
    for (const char* name : moments_and_histories) {
      CAPTURE(std::string(name));
      const bool new_one = test::read_file(folder / name) == test::read_file(whole / name);
      CHECK((is_older(folder.path(), name) || new_one));
    }
  }
  CHECK(killed > 0);
  // What the kills left behind is in nobody's way.
  REQUIRE(test::tyglab(folder.path(), call).code == 0);
  CHECK(names_in(folder.path()) == names_in(whole.path()));
}

TEST_CASE("130: an interrupt replaces no older file, and keeps what is complete under a name that says so") {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    CAPTURE(signal);
    const test::TemporaryFolder folder;
    put_older(folder.path());
    const auto outcome =
        test::tyglab_interrupted(folder.path(), run_of({"--seconds", "100000", "--json", "r.json", "--obj", "frames"}),
                                 1.0, signal, folder / "t.csv.incomplete");
    CHECK(outcome.code == 130);
    CHECK(outcome.err.find("no older file was replaced") != std::string::npos);
    for (const char* name : moments_and_histories) CHECK(is_older(folder.path(), name));
    check_series(folder / "t.csv.incomplete", 2);
    check_series(folder / "l.csv.incomplete", 2);
    CHECK(test::read_file(folder / "s.csv.incomplete").starts_with("# tyglab state"));
    CHECK(test::read_file(folder / "v.csv.incomplete").starts_with("# tyglab values"));
    const auto json = nlohmann::json::parse(test::read_file(folder / "r.json"));
    CHECK(json["status"] == "interrupted");
    const std::size_t particles = json["rows"].get<std::size_t>() * json["columns"].get<std::size_t>();
    for (const auto& file : json["files"]) {
      CHECK(outcome.out.find(file["path"].get<std::string>()) != std::string::npos);
      if (file["kind"] == "pc2")
        CHECK(fs::file_size(folder / "c.pc2.incomplete") == 32 + file["frames"].get<std::size_t>() * particles * 12);
    }
  }
}

TEST_CASE("130: where no older file stands, what is whole in itself gets its name, and the rest does not") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab_interrupted(folder.path(), run_of({"--seconds", "100000", "--json", "r.json"}), 0.5,
                                                SIGINT, folder / "t.csv.incomplete");
  CHECK(outcome.code == 130);
  CHECK(names_in(folder.path()) == std::vector<std::string>{"c.pc2.incomplete", "l.csv.incomplete", "r.json", "s.csv",
                                                            "t.csv.incomplete", "v.csv"});
  CHECK(test::lines(test::read_file(folder / "s.csv")).size() > 100);
}

TEST_CASE("130: an interrupted benchmark leaves the older results") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "b.json", "older");
  const auto outcome =
      test::tyglab_interrupted(folder.path(), {"stability", "stress", "--cases", "1000000", "--json", "b.json"}, 1.5);
  CHECK(outcome.code == 130);
  CHECK(test::read_file(folder / "b.json") == "older");
  CHECK(nlohmann::json::parse(test::read_file(folder / "b.json.incomplete")).contains("runs"));
  CHECK(outcome.err.find("complete, in b.json.incomplete.") != std::string::npos);
}

TEST_CASE("6: a full disk leaves every older file, and whole rows and frames beside them") {
  const test::TemporaryFolder folder;
  put_older(folder.path());
  // A limit of the shell for a file's size (blocks of 512 bytes) stands for the disk.
  const auto outcome = test::run(
      folder.path(), {"/bin/sh", "-c",
                      "ulimit -f 200; " + std::string(test::binary) +
                          " run hanging --steps 100000 --series t.csv --series-every 1 --ledger l.csv --pc2 c.pc2"});
  CHECK(outcome.code == 6);
  CHECK(outcome.err.find("cannot be written") != std::string::npos);
  CHECK(outcome.err.find(".incomplete") != std::string::npos);
  for (const char* name : histories) CHECK(is_older(folder.path(), name));
  check_series(folder / "t.csv.incomplete", 10);
  check_series(folder / "l.csv.incomplete", 10);
  const std::string cache = test::read_file(folder / "c.pc2.incomplete");
  REQUIRE(cache.size() > 32);
  CHECK(cache.size() == 32 + std::size_t(cache[28]) * 32 * 32 * 12);
}

TEST_CASE("6: a read-only file stops a command before its work, whoever runs it") {
  const test::TemporaryFolder folder;
  put_older(folder.path());
  for (const char* name : moments_and_histories) {
    CAPTURE(std::string(name));
    REQUIRE(::chmod((folder / name).c_str(), 0444) == 0);
    const auto outcome = test::tyglab(folder.path(), run_of({"--steps", "1000000000000"}));
    CHECK(outcome.code == 6);
    CHECK(outcome.err.find(std::string(name) + ": is read-only") != std::string::npos);
    REQUIRE(::chmod((folder / name).c_str(), 0600) == 0);
  }
  REQUIRE(test::tyglab(folder.path(), run_of({"--steps", "1"})).code == 0);
  for (const char* name : moments_and_histories) {
    CAPTURE(std::string(name));
    CHECK_FALSE(is_older(folder.path(), name));
    CHECK((fs::status(folder / name).permissions() & fs::perms::all) == fs::perms(0600));
  }
}

TEST_CASE("2: two outputs that are one file are refused, also by links to what is not there yet") {
  const test::TemporaryFolder folder;
  fs::create_symlink("m.csv", folder / "l.csv"), fs::create_symlink("s.csv", folder / "m.csv");
  for (const char* other : {"s.csv", "./s.csv", "m.csv"}) {
    CAPTURE(std::string(other));
    const auto outcome =
        test::tyglab(folder.path(), {"run", "hanging", "--steps", "1", "--state", other, "--series", "l.csv"});
    CHECK(outcome.code == 2);
    CHECK(outcome.err.find("both go to") != std::string::npos);
  }
  CHECK_FALSE(fs::exists(folder / "s.csv"));
}

TEST_CASE("--mtl puts the material and the texture beside the meshes, which assimp finds") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(folder.path(), {"run", "denim", "--steps", "1", "--set", "rows=6", "--set",
                                                    "columns=6", "--obj", "frames", "--mtl"});
  CHECK(outcome.code == 0);
  CHECK(test::read_file(folder / "frames/denim.png") ==
        test::read_file(std::string(test::source_dir) + "/textures/denim.png"));
  const auto read = test::run(folder / "frames", {test::assimp, "export", "denim_0000.obj", "again.obj"});
  REQUIRE_MESSAGE(read.code == 0, read.out);
  CHECK(test::read_file(folder / "frames/again.mtl").find("map_Kd denim.png") != std::string::npos);
  const auto alone = test::tyglab(folder.path(), {"run", "denim", "--steps", "1", "--mtl"});
  CHECK(alone.code == 2);
  CHECK(alone.err.find("--obj") != std::string::npos);
}

TEST_CASE("2: an output under the name that another has until it is whole, or that a frame of --obj has, is refused") {
  const test::TemporaryFolder folder;
  const auto refused = [&](std::vector<std::string> options, const char* words) {
    std::vector<std::string> all{"run", "hanging", "--seconds", "0.1"};
    all.insert(all.end(), options.begin(), options.end());
    const auto ended = test::tyglab(folder.path(), all);
    CHECK(ended.code == 2);
    CHECK(ended.err.find(words) != std::string::npos);
  };
  refused({"--state", "a.csv", "--series", "a.csv.incomplete"}, "until it is complete");
  refused({"--state", "a.csv.incomplete", "--series", "a.csv"}, "until it is complete");
  refused({"--obj", "frames", "--state", "frames/hanging_0001.obj"}, "--obj writes frames in that folder");
  CHECK(std::filesystem::is_empty(folder.path()));
  const auto beside = test::tyglab(folder.path(), {"run", "hanging", "--steps", "1", "--state", "hanging_0001.obj"});
  CHECK(beside.code == 0);
}

TEST_CASE("130: one signal ends a run whose output has no reader") {
  const test::TemporaryFolder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const char* option : {"--state", "--series", "--pc2"}) {
    CAPTURE(std::string(option));
    const auto outcome =
        test::tyglab_interrupted(folder.path(), {"run", "hanging", "--steps", "5", option, "pipe"}, 0.7);
    CHECK(outcome.code == 130);
  }
  const auto stalled = test::run(folder.path(), {"/bin/sh", "-c",
                                                 std::string("{ timeout --preserve-status -s TERM 1 ") + test::binary +
                                                     " run flag --seconds 1000 --series - 2>said; echo $? >code; } | "
                                                     "while [ ! -s code ]; do sleep 0.1; done"});
  CHECK(test::read_file(folder / "code") == "130\n");
}

}  // namespace tyglab::outputs_test
