// The program itself where the system has no more to give: no room on the disk at any byte, no memory, no thread.
#include <doctest/doctest.h>

#include <cstdio>

#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/sanitized.h"
#include "tests/support/skip.h"

namespace tyglab::command_line_faults_test {
namespace {

namespace fs = std::filesystem;

const std::string program = test::binary;

/// The same through a shell that sets limits first.
test::Outcome limited(const fs::path& folder, const std::string& limits, const std::string& arguments) {
  return test::run(folder, {"/bin/bash", "-c", "ulimit -c 0; " + limits + "exec " + program + " " + arguments});
}

bool told(const test::Outcome& outcome, int code, const std::string& word) {
  return outcome.code == code && outcome.err.starts_with("tyglab: ") && outcome.err.find(word) != std::string::npos;
}

void report(const char* operation, const char* kind, int tried, int survived) {
  std::printf("FAULTS %s: %s %d %d\n", operation, kind, tried, survived);
}

}  // namespace

TEST_CASE("a disk that is full at some byte ends a run with code 6, and the older file stands") {
  for (const char* option : {"--state", "--values", "--series", "--ledger", "--pc2"}) {
    int tried = 0, survived = 0;
    // None at all would leave no room for the sentence either, which goes to a file here.
    for (int kilobytes = 1; kilobytes <= (test::sanitized ? 1 : 3); ++kilobytes) {
      const test::TemporaryFolder folder;
      test::write_file(folder / "out", "older");
      const test::Outcome outcome =
          limited(folder.path(), "ulimit -f " + std::to_string(kilobytes) + "; ",
                  "run hanging --set rows=16 --set columns=16 --seconds 2 " + std::string(option) + " out");
      if (outcome.code == 0) continue;
      const bool right = told(outcome, 6, "out: cannot be written") && test::read_file(folder / "out") == "older";
      CHECK_MESSAGE(right, std::string(option) << " " << kilobytes << " kB: " << outcome.code << " " << outcome.err);
      ++tried, survived += right;
    }
    CHECK(tried > 0);
    report(("tyglab run " + std::string(option)).c_str(), "write", tried, survived);
  }
}

TEST_CASE("an output device that takes nothing ends a run with code 6") {
  int tried = 0, survived = 0;
  const test::TemporaryFolder folder;
  for (const char* option : {"--state", "--values", "--series", "--ledger", "--json"}) {
    for (const bool by_name : {true, false}) {
      const test::Outcome outcome = limited(folder.path(), "",
                                            "run hanging --set rows=8 --set columns=8 --steps 5 " +
                                                std::string(option) + (by_name ? " /dev/full" : " - > /dev/full"));
      const bool right = told(outcome, 6, "cannot be written");
      CHECK_MESSAGE(right, std::string(option) << ": " << outcome.code << " " << outcome.err);
      ++tried, survived += right;
    }
  }
  report("tyglab run to /dev/full", "write", tried, survived);
}

TEST_CASE("a limit of memory ends a run with code 5 and a sentence, whatever the limit is" *
          doctest::test_suite("slow")) {
  if (test::sanitized) return test::skip("a sanitizer takes more memory than any limit", test::Missing::of_machine);
  int tried = 0, survived = 0;
  const test::TemporaryFolder folder;
  test::write_file(folder / "s.csv", "older");
  for (const int megabytes : {250, 300, 350, 400, 450, 500, 600, 700}) {
    const test::Outcome outcome = limited(folder.path(), "ulimit -v " + std::to_string(megabytes << 10) + "; ",
                                          "run hanging --set rows=1500 --set columns=1500 --steps 1 --state s.csv");
    if (outcome.code == 0 || outcome.code == 127) continue;  // enough of it, or not even for the libraries
    const bool right =
        told(outcome, 5, "MB of memory at most (ulimit -v)") && test::read_file(folder / "s.csv") == "older";
    CHECK_MESSAGE(right, megabytes << " MB: " << outcome.code << " " << outcome.err);
    ++tried, survived += right;
  }
  CHECK(tried > 0);
  report("tyglab run", "allocation", tried, survived);
}

}  // namespace tyglab::command_line_faults_test
