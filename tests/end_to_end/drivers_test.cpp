// Drivers that die in the middle of their work, or are refused memory: the program ends with a sentence.
#include <doctest/doctest.h>

#include <filesystem>

#include "tests/support/devices.h"
#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/sanitized.h"
#include "tests/support/skip.h"

namespace tyglab::drivers_test {

/// The program with these environment variables set anew, and a home of its own, so that nothing is cached.
test::Outcome tyglab_with(const test::TemporaryFolder& home, const std::vector<std::string>& environment,
                          const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"/usr/bin/env", "HOME=" + home.path().string(),
                                   "XDG_CACHE_HOME=" + (home / ".cache").string(),
                                   "POCL_CACHE_DIR=" + (home / "pocl").string()};
  command.insert(command.end(), environment.begin(), environment.end());
  command.emplace_back(test::binary);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return test::run(home.path(), command);
}

TEST_CASE("an OpenCL driver without a linker is found out in a process of its own") {
  if (test::skipped_without_device()) return;
  const test::TemporaryFolder home;
  const std::vector<std::string> no_linker{"PATH=/nonexistent"};
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", "hanging", "--engine", "opencl", "--steps", "2"},
        {"run", "sphere", "--engine", "opencl", "--steps", "2", "--ledger", "l.csv"},
        {"render", "hanging", "--engine", "opencl", "--seconds", "0", "--size", "16x16", "--png", "a.png"}}) {
    const auto outcome = tyglab_with(home, no_linker, arguments);
    if (outcome.code == 0) return test::skip("this OpenCL driver needs no linker");
    CAPTURE(outcome.err);
    CHECK(outcome.code == 5);
    // The driver's own words are quoted, and kept in a file that is named.
    CHECK(test::lines(outcome.err).size() == 1);
    CHECK(outcome.err.find("tyglab: The OpenCL driver ") == 0);
    const std::filesystem::path log = home / ".cache/tyglab/opencl.log";
    CHECK(outcome.err.find(log.string()) != std::string::npos);
    CHECK_FALSE(test::read_file(log).empty());
  }
  // Nothing of it comes in the way of the other engine, nor of the one that is mended.
  const auto works = [&](const std::vector<std::string>& environment, const std::vector<std::string>& arguments) {
    const auto outcome = tyglab_with(home, environment, arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 0);
  };
  works(no_linker, {"run", "hanging", "--engine", "auto", "--steps", "2"});
  works(no_linker, {"devices"});
  works({}, {"run", "hanging", "--engine", "opencl", "--steps", "2"});
}

TEST_CASE("a limit of memory ends the drawing with a sentence that names it") {
  if (test::sanitized)
    return test::skip("AddressSanitizer needs more memory than any such limit", test::Missing::of_machine);
  const test::TemporaryFolder folder;
  int failed = 0;
  for (int megabytes = 200; megabytes <= 650; megabytes += 50) {
    CAPTURE(megabytes);
    const auto outcome =
        test::run(folder.path(), {"/bin/sh", "-c",
                                  "ulimit -v " + std::to_string(megabytes * 1024) + "; exec \"" +
                                      std::string(test::binary) + "\" render hanging --seconds 0 --png a.png"});
    CAPTURE(outcome.err);
    if (outcome.code == 0) continue;
    ++failed;
    CHECK(outcome.code == 5);
    CHECK(outcome.err.find("MB of memory at most (ulimit -v)") != std::string::npos);
  }
  CHECK(failed > 0);
}

}  // namespace tyglab::drivers_test
