// Names and texts of files are printed by every command, and none of them steers the terminal.
#include <doctest/doctest.h>

#include <algorithm>

#include "core/io/preset_io.h"
#include "core/io/terminal.h"
#include "tests/support/files.h"

namespace tyglab::end_to_end_terminal_test {

/// Red, a title, C1, a line that overwrites itself, a name written backwards.
const std::string evil = "\x1b[31m\x1b]0;x\x07\u009b1m\rok\u202Egpj";

void check_shown(const test::Outcome& outcome, const std::string& part) {
  const std::string all = outcome.out + outcome.err;
  CAPTURE(all);
  CHECK(all == visible(all));
  CHECK(all.find(part) != std::string::npos);
}

TEST_CASE("what files and names say is shown, and not acted on, by every command that prints it") {
  const test::TemporaryFolder folder;
  // File names may hold anything but a slash; texts of JSON must be UTF-8.
  const std::string named = evil + "\x9b", text = evil;
  std::string escaped;  // as JSON writes it, by which the reader lets it pass
  for (const char letter : text)
    escaped += letter == '\x1b'   ? "\\u001b"
               : letter == '\x07' ? "\\u0007"
               : letter == '\r'   ? "\\r"
                                  : std::string(1, letter);
  test::write_file(folder / "text.json",
                   "{\"name\": \"" + escaped + "\", \"view\": {\"texture\": \"" + escaped + ".png\"}}");
  test::write_file(folder / "key.json", "{\"" + escaped + "\": 1}");
  test::write_file(folder / "value.json", "{\"solver\": {\"integrator\": \"" + escaped + "\"}}");
  test::write_file(folder / (named + ".json"), "{}");
  test::write_file(folder / "lab.md",
                   "# " + text + "\n\n## " + text + "\n" + text + "\n```lab\nopen: " + text + "\n```\n");
  const std::vector<std::vector<std::string>> calls = {
      {"run", "text.json", "--steps", "1"},
      {"render", "text.json", "--seconds", "0", "--size", "16x16", "--png", "a.png"},
      {"presets", "check", "text.json"},
      {"presets", "check", "key.json"},
      {"run", "value.json", "--steps", "1"},
      {"run", named + ".json", "--steps", "1", "--state", named + ".csv"},
      {"run", "hanging", "--steps", "1", "--state", "missing" + named + "/a.csv"},
      {"run", named},
      {named},
      {"run", "hanging", "--set", named + "=1"},
      {"run", "hanging", "--set", "k_s=" + named},
      {"run", "hanging", "--engine", named},
      {"run", "hanging", "--integrator", named},
      {"run", "hanging", "--" + named},
      {"presets", named},
      {"labs", "check", "lab.md"},
      {"labs", "check", named},
      {named + ".json", "--frames", "1"},
  };
  for (const auto& call : calls) {
    std::string line;
    for (const std::string& word : call) line += visible(word) + " ";
    CAPTURE(line);
    check_shown(test::tyglab(folder.path(), call), "");
  }
  check_shown(test::tyglab(folder.path(), calls[1]), "\\x1b[31m");
  check_shown(test::tyglab(folder.path(), calls[5]), "\\x1b[31m");
}

TEST_CASE("a name with a line feed begins no line of its own") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab(folder.path(), {"run", "a\ntyglab: All is well."});
  CHECK(outcome.code == 3);
  CHECK(test::lines(outcome.err).size() == 1);
}

TEST_CASE("names of files and presets with line feeds stay within one line") {
  const test::TemporaryFolder folder;
  Preset preset;
  preset.name = "a\nb";
  save_preset(preset, folder / "c\nd.json");
  for (const std::vector<std::string>& call :
       {std::vector<std::string>{"run", "c\nd.json", "--steps", "1", "--state", "e\nf.csv"},
        std::vector<std::string>{"presets", "check", "c\nd.json"}}) {
    const auto outcome = test::tyglab(folder.path(), call);
    CHECK(outcome.code == 0);
    CHECK(test::lines(outcome.out).size() == 1);
    CHECK(outcome.out.find("c\\x0ad") != std::string::npos);
  }
}

TEST_CASE("files on standard output keep every byte") {
  const test::TemporaryFolder folder;
  Preset preset;
  preset.name = "a\u202Eb\xc2\x9b";
  save_preset(preset, folder / "a.json");
  CHECK(test::tyglab(folder.path(), {"presets", "show", "a.json"}).out == test::read_file(folder / "a.json"));
}

}  // namespace tyglab::end_to_end_terminal_test
