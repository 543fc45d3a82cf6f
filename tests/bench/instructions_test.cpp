// What a step costs, counted in instructions: unlike times, they are the same on a busy machine.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/bench/instructions.h"
#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/skip.h"

namespace tyglab::instructions_test {

const std::filesystem::path counts_file = std::string(test::source_dir) + "/tests/bench/instructions.txt";

/// "gcc-12": the compiler as instructions.txt calls it.
std::string compiler() {
#if defined(__clang__)
  return "clang-" + std::to_string(__clang_major__);
#else
  return "gcc-" + std::to_string(__GNUC__);
#endif
}

/// Skips the test case if instructions cannot be counted here.
bool skipped_without_counts(const InstructionCounter& counter) {
#ifndef NDEBUG
  test::skip("instructions are counted in an optimized build alone", test::Missing::of_machine);
  return true;
#endif
  if (!counter.available()) {
    test::skip("valgrind is missing: apt-get install valgrind");
    return true;
  }
  const std::string set = counter.instruction_set();
  if (set == "AVX2") return false;
  test::skip(set.empty() ? "valgrind cannot run tyglab here"
                         : "under valgrind the engine picks " + set + ", and the counts are those of AVX2",
             test::Missing::of_machine);
  return true;
}

struct Counts {
  double in_float = 0, in_double = 0;
};

std::map<std::string, Counts> known_counts() {
  std::map<std::string, Counts> known;
  for (const std::string& line : test::lines(test::read_file(counts_file))) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream words(line);
    std::string name;
    Counts counts;
    words >> name >> counts.in_float >> counts.in_double;
    CHECK_MESSAGE(bool(words), "not a compiler and two numbers: ", line);
    known[name] = counts;
  }
  return known;
}

void write_counts(const std::map<std::string, Counts>& known) {
  std::string text;
  for (const std::string& line : test::lines(test::read_file(counts_file)))
    if (line.starts_with("#")) text += line + "\n";
  for (const auto& [name, counts] : known) {
    char line[80];
    std::snprintf(line, sizeof line, "%-10s  %5.2f  %6.2f\n", name.c_str(), counts.in_float, counts.in_double);
    text += line;
  }
  test::write_file(counts_file, text);
}

TEST_CASE("a step of the default cloth costs no more instructions than it did") {
  const InstructionCounter counter(test::binary);
  if (skipped_without_counts(counter)) return;
  // The default cloth is the one with bending on.
  const auto in_float = counter.per_particle_step({"bending", SkipState::on, Precision::float_});
  const auto in_double = counter.per_particle_step({"bending", SkipState::on, Precision::double_});
  REQUIRE(in_float.has_value());
  REQUIRE(in_double.has_value());
  auto known = known_counts();
  if (std::getenv("TYGLAB_WRITE_INSTRUCTIONS") != nullptr) {
    known[compiler()] = {*in_float, *in_double};
    write_counts(known);
  }
  if (!known.contains(compiler())) {
    test::skip(counts_file.string() + " has no line for " + compiler() + ", which takes " + std::to_string(*in_float) +
                   " and " + std::to_string(*in_double) + ". TYGLAB_WRITE_INSTRUCTIONS=1 bench_tests adds it",
               test::Missing::of_machine);
    return;
  }
  CAPTURE(compiler());
  CHECK_MESSAGE(*in_float <= 1.03 * known[compiler()].in_float, "float: ", *in_float, " instead of ",
                known[compiler()].in_float);
  CHECK_MESSAGE(*in_double <= 1.03 * known[compiler()].in_double, "double: ", *in_double, " instead of ",
                known[compiler()].in_double);
}

TEST_CASE("a feature that is off costs at most 1 % more instructions than an engine without it") {
  if (skipped_without_counts(InstructionCounter(test::binary))) return;
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(folder.path(), {"bench", "skip", "--quick", "--side", "64", "--json", "skip.json"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto all = nlohmann::json::parse(test::read_file(folder / "skip.json"));
  CHECK(all["instructions_counted_with"] == "AVX2");
  CHECK(all["runs"].size() == 8);
  for (const auto& run : all["runs"]) {
    const std::string feature = run["feature"];
    CAPTURE(feature);
    const double off = run["instructions_off"], absent = run["instructions_absent"], on = run["instructions_on"];
    CHECK(off <= 1.01 * absent);
    // Where the sweep itself has it, off and absent are one engine: what is off is left out, so on takes clearly more.
    const bool swept = feature == "bending" || feature == "damping" || feature == "wind";
    CHECK(on >= (swept ? 1.1 * off : off));
    for (const char* time : {"ns_off", "ns_absent", "ns_on"}) CHECK(run[time] > 0.0);
  }
}

TEST_CASE("one case alone, for other tools") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(folder.path(), {"bench", "skip", "--only", "wind:off", "--steps", "3", "--side",
                                                    "16", "--precision", "double", "--json", "-"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto run = nlohmann::json::parse(outcome.out)["runs"][0];
  CHECK(run["feature"] == "wind");
  CHECK(run["state"] == "off");
  CHECK(run["steps"] == 3);
  CHECK(run["rows"] == 16);
  CHECK(run["precision"] == "double");
  CHECK(run["ns_per_particle_step"] > 0.0);

  const auto refused = [&](std::vector<std::string> arguments, const char* says) {
    arguments.insert(arguments.begin(), {"bench", "skip"});
    const auto wrong = test::tyglab(folder.path(), arguments);
    CHECK(wrong.code == 2);
    CHECK_MESSAGE(wrong.err.find(says) != std::string::npos, "\"", says, "\" is missing in: ", wrong.err);
  };
  refused({"--only", "rain:on"}, "known: bending");
  refused({"--only", "wind"}, "wind:off");
  refused({"--only", "wind:maybe"}, "wind:off");
  refused({"--only", "wind:absent", "--precision", "double"}, "only in float");
  refused({"--steps", "5"}, "--only");
}

/// The columns of a table end where their heads do, with the longest names too.
void check_columns(const std::string& table, std::size_t rows) {
  const std::vector<std::string> lines = test::lines(table);
  const auto head = std::find_if(lines.begin(), lines.end(),
                                 [](const std::string& line) { return line.find("  threads  ") != line.npos; });
  REQUIRE(std::size_t(lines.end() - head) == rows + 1);
  for (const char* name : {"threads", "median", "memory", "bytes"}) {
    const std::size_t end = head->find(name) + std::string_view(name).size();
    for (auto line = head + 1; line != lines.end(); ++line) {
      CAPTURE(*line);
      CHECK((line->at(end - 1) != ' ' && line->at(end) == ' '));
    }
  }
}

TEST_CASE("throughput names what each scene has and what was skipped, in columns") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(folder.path(), {"bench", "throughput", "--quick", "--repeats", "1", "--json", "-"});
  CAPTURE(outcome.err);
  REQUIRE(outcome.code == 0);
  const auto all = nlohmann::json::parse(outcome.out);
  bool windy = false;
  for (const auto& run : all["runs"]) {
    CHECK(run["features"].size() + run["skipped"].size() == 11);
    for (const char* number : {"bytes_per_particle", "register_limit_ns", "memory_limit_ns", "over_register_limit"})
      CHECK(run[number] > 0.0);
    if (run["variant"] != "wind") continue;
    windy = true;
    CHECK(run["features"] == nlohmann::json{"bending", "damping", "wind", "pins"});
    CHECK(run["skipped"] == nlohmann::json{"rigidity", "curl", "self", "air", "bodies", "tearing", "hand"});
  }
  CHECK(windy);
  check_columns(outcome.err, all["runs"].size());
}

}  // namespace tyglab::instructions_test
