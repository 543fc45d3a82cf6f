// Presets that are wrong: each is refused, and the error names file, line, key and how to mend it.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/io/json_tree.h"
#include "core/io/preset_io.h"

namespace tyglab::wrong_test {

/// What the error says; fails if there is none.
std::string error_of(const std::string& text) {
  try {
    parse_preset(text, "folder/wrong.json");
  } catch (const PresetError& error) {
    const std::string what = error.what();
    CHECK(what.find("folder/wrong.json") == 0);
    return what;
  }
  FAIL_CHECK("accepted: " << text.substr(0, 200));
  return {};
}

void check_contains(const std::string& what, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    CHECK_MESSAGE(what.find(part) != std::string::npos, "\"" << part << "\" is missing in: " << what);
  }
}

/// A file whose line 37 holds the given text inside the block.
std::string on_line_37(const std::string& block, const std::string& content) {
  return "{\n\"" + block + "\": {" + std::string(35, '\n') + content + "\n}\n}\n";
}

struct Wrong {
  std::string text;
  std::vector<std::string> parts;
};

TEST_CASE("a path that cannot be followed is refused") {
  const auto body = [](const char* rest) { return std::string("{\"bodies\": [{\"r\": 0.1, ") + rest + "}]}"; };
  for (const Wrong& wrong :
       {Wrong{body("\"path\": 3"), {"bodies[0].path", "[t, x, y, z]"}},
        {body("\"path\": [[0, 1, 2]]"), {"bodies[0].path[0]: must be [t, x, y, z], not of 3 numbers"}},
        {body("\"path\": [[0, 0, 0, 0], [0, 1, 0, 0]]"), {"bodies[0].path", "[1]", "later"}},
        {body("\"path\": [[0, 0, 2e3, 0]]"), {"bodies[0].path", "[0]", "-1000 to 1000, not 2000"}},
        {body("\"velocity\": [1, 0, 0], \"path\": [[0, 0, 0, 0]]"), {"bodies[0].path", "not both"}}})
    check_contains(error_of(wrong.text), wrong.parts);
}

TEST_CASE("an unknown key is refused with the nearest known one, its line and its path") {
  for (const Wrong& wrong :
       {Wrong{on_line_37("forces", "\"k_x\": 5"), {":37", "forces.k_x", "did you mean k"}},
        {on_line_37("forces", "\"gravity\": 5"), {":37", "forces.gravity", "k_s"}},
        {on_line_37("cloth", "\"row\": 5"), {":37", "cloth.row", "did you mean rows"}},
        {on_line_37("forces", "\"e\": 5"), {":37", "forces.e: unknown key; known: k_s"}},
        {on_line_37("solver", "\"intergrator\": \"verlet\""), {":37", "did you mean integrator"}},
        {on_line_37("tearing", "\"Fmax\": 5"), {":37", "tearing.Fmax", "did you mean F_max"}},
        {"{\"fources\": {}}", {":1", "fources", "did you mean forces"}},
        {"{\"bodies\": [{\"shape\": \"plane\", \"hight\": 0}]}", {"bodies[0].hight"}},
        {"{\"bodies\": [{}, {\"frictoin\": 0}]}", {"bodies[1].frictoin", "did you mean friction"}}}) {
    check_contains(error_of(wrong.text), wrong.parts);
  }
}

TEST_CASE("of a key that stands in the wrong place it is told where it belongs") {
  for (const Wrong& wrong :
       {Wrong{on_line_37("cloth", "\"k_s\": 5"), {":37", "cloth.k_s: unknown key; k_s belongs to \"forces\""}},
        {on_line_37("forces", "\"pins\": \"none\""), {"forces.pins: unknown key; pins belongs to \"cloth\""}},
        {on_line_37("cloth", "\"mass\": 200"), {"mass belongs to \"fabric\""}},
        {on_line_37("view", "\"engine\": \"cpu\""), {"engine belongs to \"solver\""}},
        {on_line_37("cloth", "\"name\": \"a\""), {"name belongs to the top level"}},
        {"{\"k_s\": 5}", {":1", "k_s: unknown key; k_s belongs to \"forces\""}},
        {"{\"pin_motions\": []}", {"pin_motions belongs to \"cloth\""}},
        {"{\"precision\": \"double\"}", {"precision belongs to \"solver\""}}})
    check_contains(error_of(wrong.text), wrong.parts);
}

TEST_CASE("a doubled key is refused wherever it stands") {
  for (const Wrong& wrong : {Wrong{on_line_37("forces", "\"k_s\": 5, \"g\": 1, \"k_s\": 6"), {":37", "k_s", "twice"}},
                             {"{\"forces\": {},\n\n\"forces\": {}}", {":3", "forces", "twice"}},
                             {"{\"bodies\": [{\"r\": 1,\n\"r\": 1}]}", {":2", "\"r\"", "twice"}},
                             {"{\"nonsense\": {\"a\": 1, \"a\": 1}}", {"\"a\"", "twice"}}}) {
    check_contains(error_of(wrong.text), wrong.parts);
  }
}

TEST_CASE("a wrong type is refused with what is expected") {
  for (const Wrong& wrong :
       {Wrong{on_line_37("forces", "\"k_s\": \"50\""), {":37", "forces.k_s", "a number", "the string \"50\""}},
        {on_line_37("forces", "\"k_s\": null"), {":37", "forces.k_s", "a number", "null"}},
        {on_line_37("forces", "\"k_s\": true"), {":37", "forces.k_s", "a number"}},
        {on_line_37("forces", "\"k_s\": [50]"), {":37", "forces.k_s", "a number", "a list"}},
        {on_line_37("forces", "\"k_s\": {}"), {":37", "forces.k_s", "a number"}},
        {on_line_37("forces", "\"W\": 3"), {":37", "forces.W", "three numbers"}},
        {on_line_37("forces", "\"W\": [1, 2]"), {":37", "forces.W", "three numbers", "not of 2"}},
        {on_line_37("forces", "\"W\": [1, 2, 3, 4]"), {":37", "forces.W", "three numbers"}},
        {on_line_37("forces", "\"W\": [1, \"2\", 3]"), {":37", "forces.W[1]", "a number"}},
        {on_line_37("cloth", "\"rows\": 3.5"), {":37", "cloth.rows", "a whole number"}},
        {on_line_37("cloth", "\"pins\": 3"), {":37", "cloth.pins"}},
        {on_line_37("cloth", "\"pins\": \"top\""), {":37", "cloth.pins", "top_row"}},
        {on_line_37("cloth", "\"pins\": \"list\""), {":37", "cloth.pins"}},
        {on_line_37("cloth", "\"pins\": [[1, 2], [3]]"), {":37", "cloth.pins[1]"}},
        {on_line_37("cloth", "\"pins\": [[1, 2.5]]"), {":37", "cloth.pins[0]", "a whole number"}},
        {on_line_37("solver", "\"engine\": \"gpu\""), {":37", "solver.engine", "opencl"}},
        {on_line_37("solver", "\"precision\": \"half\""), {":37", "solver.precision", "double"}},
        {on_line_37("solver", "\"precision\": 64"), {":37", "solver.precision"}},
        {on_line_37("solver", "\"integrator\": \"verlett\""), {":37", "solver.integrator", "did you mean verlet"}},
        {"{\"kind\": \"clothe\"}", {"kind", "did you mean cloth"}},
        {"{\"name\": 5}", {"name", "a string"}},
        {"{\"name\": \"" + std::string(201, 'n') + "\"}", {"name", "at most 200 bytes", "201"}},
        {"{\"cloth\": []}", {"cloth", "an object"}},
        {"{\"bodies\": {}}", {"bodies", "a list"}},
        {"{\"bodies\": [5]}", {"bodies[0]", "an object"}},
        {"{\"bodies\": [{\"shape\": \"cube\"}]}", {"bodies[0].shape", "sphere"}},
        {"[]", {"an object"}},
        {"5", {"an object"}},
        {"null", {"an object"}},
        {"\"text\"", {"an object"}}}) {
    check_contains(error_of(wrong.text), wrong.parts);
  }
}

TEST_CASE("a value out of range is refused with what is allowed") {
  for (const Wrong& wrong : {Wrong{on_line_37("forces", "\"k_s\": -1"), {":37", "forces.k_s", "-1", "0 to 1e9", "N/m"}},
                             {on_line_37("forces", "\"k_d\": 1e7"), {":37", "forces.k_d", "0 to 1000000"}},
                             {on_line_37("forces", "\"g\": 100.001"), {":37", "forces.g", "-100 to 100"}},
                             {on_line_37("forces", "\"W\": [0, 0, 1001]"), {":37", "forces.W", "1001"}},
                             {on_line_37("cloth", "\"rows\": 1"), {":37", "cloth.rows", "2 to 4096"}},
                             {on_line_37("cloth", "\"rows\": 4097"), {":37", "cloth.rows", "4097"}},
                             {on_line_37("cloth", "\"rows\": 99999999999"), {":37", "cloth.rows"}},
                             {on_line_37("cloth", "\"rows\": 99999999999999999999999"), {":37", "cloth.rows"}},
                             {on_line_37("cloth", "\"rows\": -99999999999"), {":37", "cloth.rows"}},
                             {on_line_37("cloth", "\"columns\": 0"), {":37", "cloth.columns", "1 to 4096"}},
                             {on_line_37("cloth", "\"m\": 0"), {":37", "cloth.m", "kg"}},
                             {on_line_37("solver", "\"dt\": 0"), {":37", "solver.dt", "1e-7 to 1", "s"}},
                             {on_line_37("solver", "\"dt\": 1e300"), {":37", "solver.dt"}},
                             {on_line_37("view", "\"mode\": 6"), {":37", "view.mode", "1 to 5"}},
                             {"{\"bodies\": [{\"r\": 0}]}", {"bodies[0].r", "0.001 to 100"}},
                             {"{\"bodies\": [{\"c\": [0, 0, 2000]}]}", {"bodies[0].c", "2000"}},
                             {"{\"bodies\": [{\"restitution\": 1.5}]}", {"bodies[0].restitution", "0 to 1"}}}) {
    check_contains(error_of(wrong.text), wrong.parts);
  }
}

TEST_CASE("numbers that are not finite are refused") {
  for (const char* value : {"NaN", "nan", "Infinity", "-Infinity", "inf", "1e999", "-1e999", "0x10", "1e", "+1", ".5",
                            "1.", "01", "1_000"}) {
    CAPTURE(std::string(value));
    check_contains(error_of(on_line_37("forces", std::string("\"k_s\": ") + value)), {":37"});
  }
}

TEST_CASE("pins outside the lattice are refused, whatever comes first in the file") {
  for (const char* pin : {"[5, 0]", "[0, 5]", "[-1, 0]", "[0, -1]", "[99999999999, 0]"}) {
    CAPTURE(std::string(pin));
    const std::string pins = std::string("\"pins\": [[0, 0], ") + pin + "]";
    check_contains(error_of("{\"cloth\": {\"rows\": 5, \"columns\": 5,\n" + pins + "}}"),
                   {":2", "cloth.pins", "[4, 4]"});
    check_contains(error_of("{\"cloth\": {" + pins + ",\n\"rows\": 5, \"columns\": 5}}"),
                   {":1", "cloth.pins", "[4, 4]"});
  }
}

TEST_CASE("text that is not JSON is refused with its line") {
  for (const Wrong& wrong : {Wrong{"", {}},
                             {" \n\n ", {}},
                             {"{", {":1"}},
                             {"{\n\"cloth\": {\n\"rows\": 5", {":3"}},
                             {"{\n\"cloth\": {\n\"rows\" 5}}", {":3"}},
                             {"{\n\"cloth\": {\n\"rows\": 5,}}", {":3"}},
                             {"{}\n\n}", {":3"}},
                             {"{}\n{}", {":2"}},
                             {"{} trailing", {":1"}},
                             {"{\"name\": \"no end", {":1"}},
                             {"{\"name\": \"bad \\q escape\"}", {":1"}},
                             {"{\"name\": \"bad utf-8 \xff\"}", {":1"}},
                             {"{\"name\": \"lone \\ud800 surrogate\"}", {":1"}},
                             {"{\"name\": \"raw\nline\"}", {}},
                             {"{'name': 'single'}", {":1"}},
                             {"// comment\n{}", {":1"}},
                             {std::string("{\0}", 3), {":1"}}}) {
    CAPTURE(wrong.text);
    check_contains(error_of(wrong.text), wrong.parts);
  }
}

TEST_CASE("text that is not JSON is told in plain words, with its place and how to mend it") {
  for (const auto& [text, says] : std::initializer_list<std::pair<std::string, std::string>>{
           {"{\n\"cloth\": {\n\"rows\" 5}}", ":3: column 8: a colon is missing after the key \"rows\""},
           {"{\n\"name\": \"a\"\n\"kind\": 5}", ":3: column 1: a comma is missing before this"},
           {"{\"name\": \"å\" \"kind\": 5}", ":1: column 14: a comma is missing"},
           {"{\n\"cloth\": {\"rows\": 5,}\n}", ":2: column 20: nothing follows this comma; remove it"},
           {"{\"cloth\": {\n\"x_0\": [0, 1, ]}}", ":2: column 13: nothing follows this comma; remove it"},
           {"{\"cloth\": {,}}", "one comma is enough"},
           {"{'name': 5}", ":1: column 2: keys are written in double quotes"},
           {"{name: 5}", "keys are written in double quotes: \"name\""},
           {"{\"name\" = 5}", "write a colon between a key and its value, not ="},
           {"{\"name\": denim}", "strings are written in double quotes: \"denim\""},
           {"{\"name\": 'denim'}", "strings are written in double quotes"},
           {"{\"name\": \"denim\n}", ":1: column 10: the string that begins here lacks its closing \""},
           {"{\"name\": }", "a value was expected here"},
           {"{\"name\": , \"kind\": 5}", "a value is missing before this comma"},
           {"{\"bodies\": [1 2]}", "a comma is missing before this"},
           {"{\"bodies\": [1, 2}}", "the [ before it is closed by ], not by }"},
           {"{} // all", "the preset ends before this"},
           {"{ // all\n}", "JSON has no comments"},
           {"{\"forces\": {\"k_s\": 5 # stiff\n}}", "JSON has no comments"},
           {"{\"forces\": {\"k_s\": NaN}}", "must be finite"},
           {"{\"forces\": {\"k_s\": 1e999}}", ":1: column 20: forces.k_s: 1e999 is too large for a number"},
           {"{\"bodies\": [{}, {\n\"c\": [0, -1e999, 0]}]}", ":2: column 10: bodies[1].c[1]: -1e999 is too large"},
           {"{\"forces\": {\"k_s\": +1}}", "no + sign"},
           {"{\"forces\": {\"k_s\": .5}}", "begins with a digit"},
           {"{\"forces\": {\"k_s\": 1.}}", "after the point"},
           {"{\"forces\": {\"k_s\": 1e}}", "after the e"},
           {"{\"forces\": {\"k_s\": 01}}", "leading 0"},
           {"{\"forces\": {\"k_s\": 0x10}}", "not a JSON number"},
           {"{\"name\": \"C:\\denim\"}", "write \\\\ for a backslash"},
           {"{\"name\": \"a\tb\"}", "write \\t for a tab"},
           {"{\"name\": \"\\ud800\"}", "half a surrogate pair"},
           {"{\"name\": \"\\u12\"}", "four hexadecimal digits"},
           {"{\"name\": \"\xff\"}", "not UTF-8"},
           {"\xff\xfe{", "not UTF-8"},
           {"\x89PNG\r\n\x1a\n", "this is an image, not a preset; the cloth takes it as its texture"},
           {"\xff\xd8\xff\xe0", "this is an image, not a preset"},
           {"k_s = 5", "begins with {"},
           {"", "it is empty"},
           {"{\n\"cloth\": {\n\n", ":2: the { of line 2 is never closed; add its }"},
           {"{\n\"cloth\":\n", ":2: it ends where a value is expected"},
           {"{\n\"cloth\"", "a colon and its value are missing"}}) {
    CAPTURE(text);
    const std::string what = error_of(text);
    check_contains(what, {says});
    for (const char* foreign : {"syntax error", "parse", "exception", "literal", "at line", "cannot be read"})
      CHECK_MESSAGE(what.find(foreign) == std::string::npos, what);
  }
  // The end of the file lies further down than what is unfinished, so its column says nothing.
  CHECK(error_of("{\n\"cloth\": {\n\n\n").find("column") == std::string::npos);
}

TEST_CASE("a preset that is too large for a person's file is refused with the key that makes it so") {
  const auto filled = [](const std::string& before, const std::string& part, int count, const std::string& after) {
    std::string text = before;
    for (int n = 0; n < count; ++n) text += (n == 0 ? "" : ",") + part;
    return text + after;
  };
  check_contains(error_of(filled("{\"cloth\": {\n\"pins\": [\n", "[0,0]\n", 100000, "]}}")),
                 {"cloth.pins[66665]", "too many values (200000 at most)"});
  check_contains(error_of("{\"forces\": {\n\"W\": " + std::string(20, '[') + std::string(20, ']') + "}}"),
                 {":2", "forces.W[0][0]", "nested too deeply"});
  std::string keys = "{\"forces\": {\n";
  for (int n = 0; n < 1100; ++n) keys += (n == 0 ? "\"" : ",\"") + std::to_string(n) + "\": 1";
  check_contains(error_of(keys + "}}"), {":2", "forces: too many keys in one object (1000 at most)"});
}

TEST_CASE("what is JSON and what is not is judged as another reader of JSON does") {
  const auto reads = [](const std::string& text) {
    try {
      parse_json(text, "changed.json", Lines::told);
      return true;
    } catch (const PresetError&) {
      return false;
    }
  };
  const auto judged_alike = [&](const std::string& text) {
    CHECK_MESSAGE(reads(text) == nlohmann::json::accept(text), text);
  };
  for (const char* text :
       {"[]", "5", "-0.5e-3", "\"\\u00e5 \\ud83d\\ude00\"", "true", "{\"a\": [null, {}, [false]]}", "\xEF\xBB\xBF{}"})
    CHECK_MESSAGE(reads(text), text);
  // Every beginning of a preset lacks something; every one with a character more or less may.
  const std::string right = preset_to_json({});
  CHECK(reads(right));
  for (std::size_t length = 0; length + 2 < right.size(); ++length) CHECK_FALSE(reads(right.substr(0, length)));
  for (std::size_t at = 0; at < right.size(); ++at) {
    judged_alike(right.substr(0, at) + right.substr(at + 1));
    for (const char more : {',', 'e', '0', '-', '.', '"', '\\', '}', '\xc3'})
      judged_alike(right.substr(0, at) + more + right.substr(at));
  }
}

TEST_CASE("a preset that ends anywhere is refused") {
  const std::string whole =
      R"({"tyglab_preset": 1, "name": "\u00e5 \ud83d\ude00\n", "cloth": {"rows": 15, "pins": [[0, 1]]}})";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    CAPTURE(length);
    CHECK_FALSE(error_of(whole.substr(0, length)).empty());
  }
}

TEST_CASE("deep nesting and endless lists are refused, not followed") {
  for (const int depth : {20, 1000, 1000000}) {
    error_of(std::string(depth, '['));
    error_of("{\"cloth\": " + std::string(depth, '[') + std::string(depth, ']') + "}");
    std::string objects;
    for (int n = 0; n < std::min(depth, 100000); ++n) objects += "{\"a\":";
    error_of(objects);
  }
  std::string list = "{\"cloth\": {\"pins\": [";
  for (int n = 0; n < 500000; ++n) list += "[0,0],";
  error_of(list + "[0,0]]}}");
}

TEST_CASE("a great many different keys are refused in good time") {
  std::string keys = "{\"cloth\": {";
  for (int n = 0; n < 190000; ++n) keys += "\"k" + std::to_string(n) + "\":1,";
  error_of(keys + "\"rows\": 3}}");
}

TEST_CASE("a newer version is refused with a sentence, an impossible one too") {
  check_contains(error_of("{\n\"tyglab_preset\": 2}"), {":2", "tyglab_preset", "newer", "Update"});
  check_contains(error_of("{\"tyglab_preset\": 1000000}"), {"newer"});
  error_of("{\"tyglab_preset\": 0}");
  error_of("{\"tyglab_preset\": -1}");
  for (const char* number : {"1.0", "1.5", "1e0", "2.0"})
    check_contains(error_of("{\n\"tyglab_preset\": " + std::string(number) + "}"),
                   {":2", "tyglab_preset: must be written as a whole number, like 1"});
  error_of("{\"tyglab_preset\": \"1\"}");
  // Whatever else such a file holds: its version is the first thing to say.
  check_contains(error_of("{\"from the future\": 5, \"tyglab_preset\": 2}"), {"newer"});
}

TEST_CASE("check_preset finds in a struct what the reader finds in a file") {
  const auto problem = [](auto change) {
    Preset preset;
    change(preset);
    return check_preset(preset);
  };
  check_contains(problem([](Preset& p) { p.rows = 1; }), {"cloth.rows"});
  check_contains(problem([](Preset& p) { p.integrator = "nonsense"; }), {"solver.integrator"});
  check_contains(problem([](Preset& p) { p.pins = {Pins::Mode::list, {{40, 0}}}; }), {"cloth.pins"});
  check_contains(problem([](Preset& p) { p.bodies.resize(2), p.bodies[1].r = 0; }), {"bodies[1].r"});
  CHECK(problem([](Preset& p) { p.pins = {Pins::Mode::top_row, {{40, 0}}}; }) == "");
}

}  // namespace tyglab::wrong_test
