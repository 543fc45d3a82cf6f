// The promise that comes with every shipped preset: with its own settings it stays bounded for 60 simulated seconds,
// except the one that says it explodes. A suite of its own, since it takes as long as all other tests together.
#include <doctest/doctest.h>

#include <algorithm>

#include "tests/support/files.h"
#include "tests/support/places.h"
#include "tests/support/sanitized.h"

namespace tyglab::endurance_test {

namespace fs = std::filesystem;

/// A sanitizer makes each step about ten times as slow, and finds what it finds in the first seconds.
constexpr const char* seconds = test::sanitized ? "2" : "60";

std::vector<std::string> shipped() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(std::string(test::source_dir) + "/app/presets")) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST_SUITE_BEGIN("endurance");

TEST_CASE("every shipped preset stays bounded for 60 simulated seconds, except the one that explodes") {
  const test::TemporaryFolder folder;
  for (const std::string& name : shipped()) {
    CAPTURE(name);
    const auto outcome = test::tyglab(folder.path(), {"run", name, "--seconds", seconds});
    CHECK_MESSAGE(outcome.code == (name == "explodes" ? 4 : 0), outcome.err);
  }
}

TEST_SUITE_END();

}  // namespace tyglab::endurance_test
