// `tyglab verify` as a process: its table, its JSON, its exit codes, and the page that is written from them.
#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/verify/gallery.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace tyglab::verify_test {

nlohmann::ordered_json read_json(const std::filesystem::path& file) {
  std::ifstream in(file);
  return nlohmann::ordered_json::parse(in);
}

TEST_CASE("verify writes the cases that are named, with the fields that programs rely on") {
  const test::TemporaryFolder folder;
  const auto run = test::tyglab(folder.path(), {"verify", "slide", "free_fall_first_order", "--json", "v.json"});
  CHECK(run.code == 0);
  CHECK(run.err.empty());
  const auto lines = test::lines(run.out);
  REQUIRE(lines.size() == 5);  // machine, head, a line a case, how many hold
  CHECK(lines[2].starts_with("free_fall_first_order "));
  CHECK(lines[3].starts_with("slide "));
  CHECK(lines[4] == "2 of 2 cases hold.");
  for (std::size_t n = 2; n < 4; ++n) CHECK(lines[n].ends_with("  ok"));
  const auto json = read_json(folder / "v.json");
  for (const char* key : {"machine", "version", "build", "date"}) CHECK(json.contains(key));
  CHECK_FALSE(json.contains("runs"));
  REQUIRE(json["cases"].size() == 2);
  for (const auto& one : json["cases"]) {
    auto item = one.items().begin();
    for (const char* field : {"name", "exact", "measured", "error", "allowed", "order", "source", "ok"}) {
      CHECK(item.key() == field);
      ++item;
    }
    CHECK(one["ok"] == true);
    CHECK(one["error"].get<double>() <= one["allowed"].get<double>());
    const double exact = one["exact"], measured = one["measured"];
    CHECK(one["error"].get<double>() == doctest::Approx(std::abs(measured - exact) / std::abs(exact)));
  }
  CHECK(json["cases"][0]["order"].get<double>() == doctest::Approx(1).epsilon(0.01));
  CHECK(json["cases"][1]["order"].is_null());
}

TEST_CASE("1: a case fails; the table, the message and the JSON say which") {
  const test::TemporaryFolder folder;
  const auto run = test::tyglab(folder.path(), {"verify", "slide", "wind", "--disturb", "g=1.01", "--json", "v.json"});
  CHECK(run.code == 1);
  CHECK(run.err == "tyglab: 1 of 2 cases failed: slide.\n");
  CHECK(run.out.find("FAILS") != std::string::npos);
  CHECK(run.out.ends_with("\n1 of 2 cases hold.\n"));
  const auto json = read_json(folder / "v.json");
  CHECK(json["disturb"] == "g=1.01");
  CHECK(json["cases"][0]["ok"] == true);
  CHECK(json["cases"][1]["name"] == "slide");
  CHECK(json["cases"][1]["ok"] == false);
  CHECK(json["cases"][1]["error"].get<double>() == doctest::Approx(0.0099).epsilon(1e-3));
}

TEST_CASE("2: a wrong command line is refused with what is allowed") {
  const test::TemporaryFolder folder;
  struct Wrong {
    std::vector<std::string> words;
    std::vector<std::string> says;
  };
  for (const Wrong& wrong :
       {Wrong{{"verify", "slid"}, {"slid:", "did you mean slide", "pendulum, "}},
        Wrong{{"verify", "slide", "nothing"}, {"nothing:", "free_fall, "}},
        Wrong{{"verify", "slide", "--disturb", "L=2"}, {"L is no constant of the forces. These are: k_s"}},
        Wrong{{"verify", "slide", "--disturb", "gg=2"}, {"did you mean g? These are: k_s"}},
        Wrong{{"verify", "slide", "--disturb", "g"}, {"g=1.1"}},
        Wrong{{"verify", "slide", "--disturb", "g=x"}, {"'x' is not a number"}},
        Wrong{{"verify", "slide", "--disturb", "g=-1"}, {"0 to"}},
        Wrong{{"verify", "slide", "--json", ""}, {"--json"}}}) {
    const auto run = test::tyglab(folder.path(), wrong.words);
    CHECK(run.code == 2);
    CHECK(run.out.empty());
    for (const std::string& says : wrong.says) CHECK_MESSAGE(run.err.find(says) != std::string::npos, run.err);
  }
  CHECK(test::tyglab(folder.path(), {"verify", "slide", "--json", "none/x.json"}).code == 6);
  const auto help = test::tyglab(folder.path(), {"verify", "--help"});
  CHECK(help.code == 0);
  CHECK(help.out.find("xample") != std::string::npos);
}

TEST_CASE("docs/verification.md shows every case of the gallery") {
  const std::string page = test::read_file(std::string(test::source_dir) + "/docs/verification.md");
  for (const verify::Case* one : verify::all_cases()) {
    CAPTURE(std::string(one->name));
    CHECK(page.find("`" + std::string(one->name) + "`") != std::string::npos);
    CHECK(page.find(one->formula) != std::string::npos);
    CHECK(page.find(one->source) != std::string::npos);
  }
  for (const std::string& line : test::lines(page)) CHECK_MESSAGE(line.find("FAILS") == std::string::npos, line);
}

}  // namespace tyglab::verify_test
