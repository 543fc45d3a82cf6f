// Experiments that strangers may send, made of good ones: values, words and steps are changed, events are moved,
// doubled and left out, and files are damaged as bytes. The target (targets.h) says what must hold; most of these are
// read, and then repeated. The generator is seeded: the message holds the number of the input.
#include <doctest/doctest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "app/base/experiment_file.h"
#include "app/base/image.h"
#include "core/io/preset_io.h"
#include "tests/fuzz/targets.h"
#include "tests/support/files.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::experiment_fuzz_test {

using test::Random;

constexpr int inputs = 3000;

const fuzz::Target& target() {
  for (const fuzz::Target& one : fuzz::targets())
    if (one.name == "experiments") return one;
  FAIL("there is no target of experiments");
  std::abort();
}

const std::vector<std::string> scalars = test::split(
    "0 -0 1 -1 2 3 4 5 7 50 3.5 1e-9 1e9 -1e9 1e300 1e309 4096 1000000 1073741824 2147483648 99999999999999999999 NaN "
    "null true false \"\" \"set\" \"restart\" \"grab\" \"hand\" \"release\" \"cut\" \"pin\" \"body\" \"resume\" "
    "\"state\" \"hash\" \"look\" \"diverged\" \"mark\" \"0123456789abcdef\" \"AAAA\" \"k_s=1e9\" \"k_s=0\" \"dt=1\" "
    "\"dt=1e-9\" \"rows=3\" \"columns=7\" \"rows=1\" \"pins=none\" \"pins=[[0,0],[9,9]]\" \"bodies=[]\" \"F_max=1e-9\" "
    "\"tearing.mode=split\" \"tearing.mode=springs\" \"self=guard\" \"self=repel\" \"engine=plain\" "
    "\"kind=one_weight\" "
    "\"integrator=implicit_euler\" \"integrator=dopri5\" \"integrator=vbd\" \"integrator=xpbd\" \"precision=float\" "
    "\"precision=double\" \"texture=/etc/passwd\" \"view.texture=../x\" \"B=1e-4\" \"g=1e9\" [] {} [0,0,0]",
    ' ');

const std::string& pick(Random& random, const std::vector<std::string>& from) {
  return from[std::size_t(random.below(int(from.size())))];
}

/// Another value in the place of one of a line.
std::string with_other_value(Random& random, std::string line) {
  std::vector<std::size_t> commas;
  for (std::size_t n = 0; n < line.size(); ++n)
    if (line[n] == ',' || line[n] == '[' || line[n] == ']') commas.push_back(n);
  if (commas.size() < 2) return line;
  const std::size_t n = std::size_t(random.below(int(commas.size()) - 1)), begin = commas[n] + 1;
  return line.replace(begin, commas[n + 1] - begin, pick(random, scalars));
}

std::string changed(Random& random, const std::string& seed) {
  std::vector<std::string> lines = test::split(seed, '\n');
  for (int changes = 1 + random.below(4); changes > 0; --changes) {
    const std::size_t at = std::size_t(random.below(int(lines.size())));
    const std::size_t other = std::size_t(random.below(int(lines.size())));
    const auto place = [&](std::size_t n) { return lines.begin() + std::ptrdiff_t(n); };
    const bool events = lines[at].starts_with('[') && lines[other].starts_with('[');
    switch (random.below(events ? 8 : 2)) {
      case 0:
        lines[at] = with_other_value(random, lines[at]);
        break;
      case 1:
        if (const std::size_t steps = lines[at].find("\"steps\": "); steps != std::string::npos)
          lines[at] = "\"steps\": " + std::to_string(random.below(60)) + ",";
        break;
      case 2: {  // the words of another event at this one's step
        const std::size_t word = lines[at].find(','), others = lines[other].find(',');
        lines[at] = lines[at].substr(0, word) + lines[other].substr(others);
        break;
      }
      case 3:
        std::swap(lines[at], lines[other]);
        break;
      case 4:
        lines.insert(place(at), std::string(lines[at]));
        break;
      case 5:
        lines.erase(place(at));
        break;
      default:
        lines[at] = with_other_value(random, lines[at]);
    }
  }
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string packed_again(const std::string& text, std::size_t said) {
  return "tyglab experiment\n" + std::to_string(said) + "\n" + packed(text);
}

TEST_CASE("changed experiments are refused, or repeated to their end" * doctest::test_suite("slow")) {
  std::vector<std::string> seeds;
  for (const std::string& seed : target().seeds())
    if (seed.starts_with('{')) seeds.push_back(seed);
  REQUIRE(!seeds.empty());
  Random random(41);
  int read = 0, refused = 0;
  for (int n = 0; n < test::fewer(inputs, inputs / 8); ++n) {
    CAPTURE(n);
    std::string input = changed(random, pick(random, seeds));
    CAPTURE(input);
    if (random.below(8) == 0) {
      input = packed_again(input, input.size() + std::size_t(random.below(2)));
      if (random.below(2) == 0) input[std::size_t(random.below(int(input.size())))] = char(random.below(256));
    }
    target().read(input);
    try {
      experiment_from(input, "again");
      ++read;
    } catch (const PresetError&) {
      ++refused;
    }
  }
  // Both ways are gone.
  CHECK(read > 50);
  CHECK(refused > 50);
}

}  // namespace tyglab::experiment_fuzz_test
