// `tyglab stability` as a process: what it writes, and what it says to a wrong command line.
#include <doctest/doctest.h>

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
        Wrong{{"stability", "stress", "--quick", "--cases", "5"}, "cannot be given together"},
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
