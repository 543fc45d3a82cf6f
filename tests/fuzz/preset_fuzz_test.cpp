// Whatever the reader is given, it answers with a preset that passes check_preset or with a PresetError; nothing else.
// The generator is seeded, so a failure can be repeated: the message holds the number and the text of the input.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "core/io/preset_io.h"
#include "core/model/notation.h"
#include "core/model/words.h"
#include "tests/support/files.h"
#include "tests/support/scenes.h"

namespace tyglab::preset_fuzz_test {

using test::Random;

constexpr int inputs_of_each_kind = 6000;

const std::string& pick(Random& random, const std::vector<std::string>& from) {
  return from[std::size_t(random.below(int(from.size())))];
}

const std::vector<std::string> scalars = test::split(
    "0 -0 1 -1 3.5 1e-9 1e9 1e308 1e309 -1e999 4096 4097 2147483648 -9223372036854775808 "
    "18446744073709551616 5e-324 0.1e NaN Infinity -Infinity null true false \"\" \"verlet\" \"top_row\" "
    "\"plane\" \"sphere\" \"cpu\" \"double\" \"one_weight\" \"\\u0000\" \"\\ud83e\\uddf5\" \"\\ud800\" "
    "\"\xff\xfe\" \"\xc3\xa5\" \"a\nb\" [] {} [0,0,0] [1e3,-1e3,0] [0,0] [[0,0]] [[0,0],[31,31]] "
    "[[9999999999,0]] [null] [[[[]]]] {\"a\":{}}",
    ' ');

const std::vector<std::string> tokens = [] {
  std::vector<std::string> all = test::split(
      "{ } [ ] : , \" \\ null tru 1e - \n \t \xEF\xBB\xBF // /* \xf0\x9f \"k_s\" \"cloth\" \"bodies\" "
      "\"tyglab_preset\" e999 0x ' \"x_0\":[1,2,3] ,\"rows\":2 ,, ]]",
      ' ');
  all.insert(all.end(), {" ", std::string("\x00\x01", 2)});
  return all;
}();

std::vector<std::string> all_keys() {
  std::vector<std::string> keys = {
      "tyglab_preset", "kind",      "name",        "description", "cloth", "forces", "tearing", "bodies", "solver",
      "view",          "pins",      "engine",      "precision",   "shape", "",       "rowss",   "K_S",    "bodies[0]",
      "k_s ",          "\\u006b_s", "pin_motions", "path",        "until", "fabric", "warp",    "self",   "guard"};
  for (const PresetRow& row : notation()) keys.emplace_back(row.key);
  for (const BodyRow& row : body_notation()) keys.emplace_back(row.key);
  return keys;
}

Preset sample(Random& random) {
  Preset preset;
  preset.rows = 2 + random.below(60);
  preset.columns = 1 + random.below(60);
  preset.description = "täcke";
  preset.bodies.resize(std::size_t(random.below(4)));
  for (Body& body : preset.bodies) body.shape = Body::Shape(random.below(int(shape_names.size())));
  if (random.below(3) == 0) preset.pins = {Pins::Mode::list, {{0, 0}, {preset.rows - 1, preset.columns - 1}}};
  if (random.below(3) == 0)
    preset.pins.motions = {{Pins::Mode::list, {{0, 0}}, {{0, {0, 0, 0}}, {1, {0, 0.5, 0}}}, {0, 3, 0}, {0, 1, 0}, 2}};
  return preset;
}

/// Flips, removes, doubles and swaps bytes.
std::string mutate_bytes(Random& random, std::string text) {
  for (int n = 1 + random.below(8); n > 0 && !text.empty(); --n) {
    const std::size_t at = std::size_t(random.below(int(text.size())));
    switch (random.below(5)) {
      case 0:
        text[at] = char(random.below(256));
        break;
      case 1:
        text[at] = char(text[at] ^ (1 << random.below(8)));
        break;
      case 2:
        text.erase(at, std::size_t(1 + random.below(20)));
        break;
      case 3:
        text.insert(at, text.substr(at, std::size_t(1 + random.below(40))));
        break;
      default:
        text.resize(at);
        break;
    }
  }
  return text;
}

/// Replaces what stands between two separators, or puts a token in.
std::string mutate_tokens(Random& random, std::string text) {
  for (int n = 1 + random.below(4); n > 0; --n) {
    const std::size_t at = std::size_t(random.below(int(text.size())));
    const std::size_t begin = text.find_first_of(":,[{", at);
    if (begin == text.npos || random.below(4) == 0) {
      text.insert(at, pick(random, tokens));
      continue;
    }
    const std::size_t end = text.find_first_of(",]}:", begin + 1);
    if (end == text.npos) continue;
    text.replace(begin + 1, end - begin - 1, pick(random, scalars));
  }
  return text;
}

void random_value(Random& random, const std::vector<std::string>& keys, int depth, std::string& out) {
  const int kind = random.below(depth <= 0 ? 1 : 4);
  if (kind <= 1) {
    out += pick(random, scalars);
    return;
  }
  out += kind == 2 ? "[" : "{";
  for (int n = random.below(6); n > 0; --n) {
    if (kind == 3) out += "\"" + keys[std::size_t(random.below(int(keys.size())))] + "\":";
    random_value(random, keys, depth - 1, out);
    if (n > 1) out += random.below(40) == 0 ? "" : ",";
  }
  out += kind == 2 ? "]" : "}";
}

/// JSON of known keys in known and unknown places, with plausible and absurd values.
std::string random_json(Random& random, const std::vector<std::string>& keys) {
  std::string text = "{";
  for (int n = random.below(6); n > 0; --n) {
    static const std::vector<std::string> sections{"cloth", "forces", "tearing", "solver", "view", "bodies"};
    text += "\"" + pick(random, sections) + "\":";
    if (random.below(8) == 0) {
      random_value(random, keys, 3, text);
    } else {
      text += "{";
      for (int k = random.below(4); k > 0; --k) {
        text += "\"" + keys[std::size_t(random.below(int(keys.size())))] + "\":";
        random_value(random, keys, 2, text);
        if (k > 1) text += ",";
      }
      text += "}";
    }
    if (n > 1) text += ",";
  }
  return text + (random.below(20) == 0 ? "" : "}");
}

struct Count {
  int accepted = 0, refused = 0;
};

/// One input; anything but a good preset or a PresetError with a message fails the test.
template <class Read>
void judge(const Read& read, const std::string& input, Count& count) {
  try {
    const Preset preset = read(input);
    ++count.accepted;
    const std::string problem = check_preset(preset);
    if (!problem.empty()) FAIL_CHECK("accepted although " << problem << ": " << input);
    if (!(parse_preset(preset_to_json(preset), "again") == preset)) FAIL_CHECK("no round trip: " << input);
  } catch (const PresetError& error) {
    ++count.refused;
    if (std::string(error.what()).size() < 8) FAIL_CHECK("refused without a reason: " << input);
  } catch (const std::exception& error) {
    FAIL_CHECK("another exception, " << error.what() << ": " << input);
  }
}

Preset parse(const std::string& text) {
  return parse_preset(text, "fuzz.json");
}

TEST_CASE("valid presets with changed bytes") {
  Random random(1);
  Count count;
  for (int n = 0; n < inputs_of_each_kind; ++n) {
    judge(parse, mutate_bytes(random, preset_to_json(sample(random))), count);
  }
  CHECK(count.accepted > 10);
  CHECK(count.refused > 1000);
}

TEST_CASE("valid presets with changed tokens") {
  Random random(2);
  Count count;
  for (int n = 0; n < inputs_of_each_kind; ++n) {
    judge(parse, mutate_tokens(random, preset_to_json(sample(random))), count);
  }
  CHECK(count.accepted > 10);
  CHECK(count.refused > 1000);
}

TEST_CASE("random JSON of known and unknown keys") {
  Random random(3);
  Count count;
  const auto keys = all_keys();
  for (int n = 0; n < inputs_of_each_kind; ++n) judge(parse, random_json(random, keys), count);
  CHECK(count.accepted > 10);
  CHECK(count.refused > 1000);
}

TEST_CASE("random bytes, and nesting without end") {
  Random random(4);
  Count count;
  for (int n = 0; n < inputs_of_each_kind / 2; ++n) {
    std::string text;
    for (int length = random.below(200); length > 0; --length) {
      text += random.below(3) == 0 ? pick(random, tokens) : std::string(1, char(random.below(256)));
    }
    judge(parse, text, count);
    static const std::vector<std::string> openers{"[", "{\"cloth\":", "{\"bodies\":[", "[[[{\"a\":", "{\"k\":[{\"k\":"};
    std::string nested;
    const std::string& opener = pick(random, openers);
    for (int depth = random.below(200); depth > 0; --depth) nested += opener;
    judge(parse, nested + pick(random, scalars), count);
  }
  CHECK(count.refused > inputs_of_each_kind / 2);
}

TEST_CASE("random settings") {
  Random random(5);
  Count count;
  const auto keys = all_keys();
  static const std::vector<std::string> places{
      "",        "",       "",        "bodies[0].", "bodies[1].", "bodies[999999999999].",
      "bodies[", "cloth.", "forces.", "solver.",    ".",          "bodies[-1]."};
  static const std::vector<std::string> between{"=", "=", "=", "=", "=", "", "==", " = ", ":"};
  for (int n = 0; n < inputs_of_each_kind; ++n) {
    const Preset base = sample(random);
    std::vector<std::string> settings;
    std::string all;
    for (int k = 1 + random.below(3); k > 0; --k) {
      std::string setting = pick(random, places) + keys[std::size_t(random.below(int(keys.size())))] +
                            pick(random, between) + pick(random, scalars);
      if (random.below(6) == 0) setting = mutate_bytes(random, setting);
      all += setting + " ";
      settings.push_back(setting);
    }
    judge([&](const std::string&) { return with_settings(base, settings); }, all, count);
  }
  CHECK(count.accepted > 10);
  CHECK(count.refused > 1000);
}

}  // namespace tyglab::preset_fuzz_test
