// The targets of Clang's libFuzzer (targets.h) where there is no Clang: their seeds, and some inputs made of them. What
// does not hold ends the program with a sentence.
#include "tests/fuzz/targets.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/support/scenes.h"

namespace tyglab::targets_fuzz_test {

using test::Random;

/// Changes bytes, leaves some out, and goes on with another seed's.
std::string mutated(Random& random, std::string text, const std::vector<std::string>& seeds) {
  for (int n = 1 + random.below(6); n > 0 && !text.empty(); --n) {
    const std::size_t at = std::size_t(random.below(int(text.size())));
    const std::string& other = seeds[std::size_t(random.below(int(seeds.size())))];
    switch (random.below(4)) {
      case 0:
        text[at] = char(random.below(256));
        break;
      case 1:
        text.erase(at, std::size_t(1 + random.below(16)));
        break;
      case 2:
        text.insert(at, other.substr(0, std::size_t(random.below(64))));
        break;
      default:
        text = text.substr(0, at) + "\n" + other;
    }
  }
  return text;
}

TEST_CASE("targets without a generator of their own answer a few thousand inputs" * doctest::test_suite("slow")) {
  for (const fuzz::Target& target : fuzz::targets()) {
    if (target.name == "presets" || target.name == "settings" || target.name == "pictures") continue;
    CAPTURE(std::string(target.name));
    const std::vector<std::string> seeds = target.seeds();
    REQUIRE_FALSE(seeds.empty());
    for (const std::string& seed : seeds) target.read(seed);
    Random random(6);
    for (int n = 0; n < 1500; ++n)
      target.read(mutated(random, seeds[std::size_t(random.below(int(seeds.size())))], seeds));
  }
}

}  // namespace tyglab::targets_fuzz_test
