// `tyglab stability` as a process: what it writes, and what it says to a wrong command line.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/files.h"
#include "tests/support/sanitized.h"

namespace tyglab::stability_test {

nlohmann::ordered_json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::ordered_json::parse(in);
}

TEST_CASE("stress writes every case, and goes on where it is told") {
  const test::TemporaryFolder folder;
  const auto run = test::tyglab(folder.path(), {"stability", "stress", "--cases", "12", "--json", "all.json"});
  CHECK(run.code == 0);
  const auto all = read_json(folder / "all.json");
  CHECK(all["runs"].size() == 12);
  CHECK(all["failed"] == 0);
  const auto later =
      test::tyglab(folder.path(), {"stability", "stress", "--cases", "3", "--from", "10", "--json", "later.json"});
  CHECK(later.code == 0);
  const auto runs = read_json(folder / "later.json")["runs"];
  REQUIRE(runs.size() == 3);
  for (std::size_t n = 0; n < 3; ++n) {
    CHECK(runs[n]["case"] == 10 + n);
    CHECK(runs[n]["status"] == all["runs"][9 + n]["status"]);
    CHECK(runs[n]["steps"] == all["runs"][9 + n]["steps"]);
  }
  for (const auto& one : all["runs"]) {
    if (one["status"] != "diverged") continue;
    for (const char* key : {"t_s", "step", "i", "j"}) CHECK(one[key].is_number());
    CHECK(!one["cause"].get<std::string>().empty());
    CHECK(!one["remedy"].get<std::string>().empty());
  }
  const auto only = test::tyglab(folder.path(), {"stability", "stress", "--only", "5"});
  CHECK(only.code == 0);
  CHECK(only.out.find("\"tyglab_preset\": 1") != std::string::npos);
  CHECK(only.out.find("\"status\"") != std::string::npos);
}

TEST_CASE("boundary writes its rows in the order that programs rely on, each within 1 % of its prediction" *
          doctest::skip(test::sanitized)) {
  const test::TemporaryFolder folder;
  const auto run = test::tyglab(folder.path(), {"stability", "boundary", "--quick", "--json", "boundary.json"});
  CHECK(run.code == 0);
  const auto json = read_json(folder / "boundary.json");
  const std::vector<std::string> fields{"scene", "integrator", "k_s", "k_d", "dt_predicted", "dt_measured", "ratio"};
  CHECK(json["runs"].size() >= 60);
  for (const auto& row : json["runs"]) {
    auto item = row.items().begin();
    for (const std::string& field : fields) {
      CHECK(item.key() == field);
      ++item;
    }
    CHECK(row["ratio"].get<double>() == doctest::Approx(1).epsilon(0.01));
  }
  for (const auto& row : json["k_s_runs"]) CHECK(row["ratio"].get<double>() == doctest::Approx(1).epsilon(0.02));
  for (const auto& row : json["growth_runs"]) CHECK(row["ratio"].get<double>() == doctest::Approx(1).epsilon(0.05));
  CHECK(json["slack_runs"].size() > 0);
}

TEST_CASE("drift tells every method on both scenes; which of them loses, keeps and gains energy" *
          doctest::skip(test::sanitized)) {
  const test::TemporaryFolder folder;
  const auto run = test::tyglab(folder.path(), {"stability", "drift", "--quick", "--json", "drift.json"});
  CHECK(run.code == 0);
  const auto json = read_json(folder / "drift.json");
  CHECK(json["benchmark"] == "stability drift");
  for (const auto& row : json["runs"]) {
    CHECK((row["scene"] == "taut_sheet" || row["scene"] == "slack_sheet"));
    CHECK((row["status"] == "diverged") == row["diverged_at_step"].is_number());
    CHECK(row["t_s"].size() == row["energy_less_start_J"].size());
  }
}

TEST_CASE("an interrupted map prints the cells that it has where they belong") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab_interrupted(folder.path(), {"stability", "map", "hanging", "--csv", "m.csv"},
                                                test::sanitized ? 15 : 1.5);
  REQUIRE(outcome.code == 130);
  double first = 0, last = 0;
  std::vector<std::string> drawn;
  for (const std::string& line : test::lines(outcome.out)) {
    if (line.starts_with("dt ")) drawn.push_back(line.substr(std::string("dt 123456789 s  ").size()));
    if (line.starts_with("k_s from ")) REQUIRE(std::sscanf(line.c_str(), "k_s from %lf to %lf", &first, &last) == 2);
  }
  REQUIRE(first > 0);
  constexpr int columns = 36;
  std::size_t row = 0, cells = 0;
  std::string dt;
  int at = 0;              // where in the row the next cell can stand
  std::size_t letter = 0;  // and where in its text
  for (const std::string& line : test::lines(test::read_file(folder / "m.csv.incomplete"))) {
    if (line.starts_with('#') || line.starts_with("k_s")) continue;
    const std::size_t comma = line.find(','), second = line.find(',', comma + 1);
    const std::string this_dt = line.substr(comma + 1, second - comma - 1);
    if (this_dt != dt) row += !dt.empty(), dt = this_dt, at = 0, letter = 0;
    const int column = int(std::lround((columns - 1) * std::log(std::stod(line) / first) / std::log(last / first)));
    REQUIRE(row < drawn.size());
    for (; at < column; ++at, letter += 2) REQUIRE(drawn[row].substr(letter, 2) == "  ");
    const std::string mark = line.find("diverged") != std::string::npos ? "×" : "·";
    CHECK(drawn[row].substr(letter + 1, mark.size()) == mark);
    letter += 1 + mark.size(), ++at, ++cells;
  }
  CHECK(row + 1 == drawn.size());
  CHECK(cells > 10);
  CHECK(cells < columns * 26);
}

TEST_CASE("a wrong command line is refused with what is allowed") {
  const test::TemporaryFolder folder;
  struct Wrong {
    std::vector<std::string> words;
    std::string says;
  };
  for (const Wrong& wrong :
       {Wrong{{"stability"}, "boundary, drift, stress"}, Wrong{{"stability", "bounday"}, "boundary"},
        Wrong{{"stability", "stress", "--cases", "0"}, "1 to"}, Wrong{{"stability", "stress", "--seed", "x"}, "seed"},
        Wrong{{"stability", "stress", "--integrator", "vdb"}, "vbd"},
        Wrong{{"stability", "stress", "--quick", "--cases", "5"}, "cannot be combined"},
        Wrong{{"stability", "map", "cusick", "--quick"}, "cusick: k_s has no effect while k_warp, k_weft and k_shear"},
        Wrong{{"stability", "boundary", "--json", "a", "--png", "a"}, "--png"}}) {
    const auto run = test::tyglab(folder.path(), wrong.words);
    CAPTURE(wrong.says);
    CHECK(run.code == 2);
    CHECK_MESSAGE(run.err.find(wrong.says) != std::string::npos, run.err);
  }
  CHECK(test::tyglab(folder.path(), {"stability", "drift", "--json", "none/x.json"}).code == 6);
  for (const char* name : {"boundary", "drift", "stress"}) {
    const auto help = test::tyglab(folder.path(), {"stability", name, "--help"});
    CHECK(help.code == 0);
    CHECK(help.out.find("xample") != std::string::npos);
  }
}

}  // namespace tyglab::stability_test
