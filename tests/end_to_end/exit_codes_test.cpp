// The program as a process: exit codes and what it says, as docs and scripts rely on them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>

#include "core/io/preset_io.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace tyglab::exit_codes_test {

namespace fs = std::filesystem;

struct Call {
  std::vector<std::string> arguments;
  int code;
  std::string says;  ///< somewhere in stdout or stderr
};

void check_calls(const std::vector<Call>& calls, const fs::path& folder) {
  for (const Call& call : calls) {
    std::string line;
    for (const std::string& word : call.arguments) line += word + " ";
    CAPTURE(line);
    const auto outcome = test::tyglab(folder, call.arguments);
    CHECK(outcome.code == call.code);
    const std::string all = outcome.out + outcome.err;
    CHECK_MESSAGE(all.find(call.says) != std::string::npos, "\"" << call.says << "\" is missing in: " << all);
    if (call.code != 0) CHECK_FALSE(outcome.err.empty());
  }
}

TEST_CASE("3: a preset's texture lies outside its folder; one that the user chose may lie anywhere") {
  const test::TemporaryFolder folder;
  fs::copy_file(std::string(test::source_dir) + "/textures/linen.png", folder / "own.png");
  fs::create_directory(folder / "sub");
  for (const char* texture : {"../own.png", "/etc/passwd"})
    for (const char* command : {"run", "render"}) {
      test::write_file(folder / "sub/a.json", std::string("{\"view\": {\"texture\": \"") + texture + "\"}}");
      std::vector<std::string> call{command, "sub/a.json"};
      if (std::string(command) == "render") call.insert(call.end(), {"--png", "a.png"});
      check_calls({{call, 3, "sub/a.json:1: view.texture: '"}}, folder.path());
    }
  test::write_file(folder / "sub/a.json", "{}");
  const auto chosen = test::tyglab(folder.path(), {"render", "sub/a.json", "--set", "texture=own.png", "--seconds", "0",
                                                   "--size", "16x16", "--png", "a.png"});
  CHECK(chosen.code == 0);
  CHECK(chosen.err.empty());
}

TEST_CASE("a page's link is a preset; 3: one that is broken") {
  const test::TemporaryFolder folder;
  const auto state = [&](const std::vector<std::string>& scene) {
    std::vector<std::string> call{"run"};
    call.insert(call.end(), scene.begin(), scene.end());
    call.insert(call.end(), {"--steps", "20", "--state", "state.csv"});
    CHECK(test::tyglab(folder.path(), call).code == 0);
    return test::read_file(folder / "state.csv");
  };
  const std::string typed = state({"flag", "--set", "k_s=80", "--set", "W=[0,0,0.01]"});
  CHECK(state({"https://example.org/a/#flag&k_s=80&W=%5B0,0,0.01%5D"}) == typed);
  CHECK(state({"#flag&k_s=90&W=[0,0,0.01]", "--set", "k_s=80"}) == typed);
  check_calls({{{"run", "#nothing", "--steps", "1"}, 3, "names no shipped preset: 'nothing'"},
               {{"run", "https://example.org/#flag&k_s=x%", "--steps", "1"}, 3, "hexadecimal"},
               {{"run", "#flag&k_s=-1", "--steps", "1"}, 3, "The link's k_s=-1"},
               {{"run", "#", "--steps", "1"}, 3, "names neither a preset nor a constant"},
               {{"run", "#hanging&k_s=1&k_s=2", "--steps", "1"}, 3, "sets 'k_s' twice"},
               {{"run", "https://example.org/my_preset.json", "--steps", "1"}, 3, "download the file first"},
               {{"https://example.org/my_preset.json", "--frames", "1"}, 3, "download the file first"}},
              folder.path());
}

TEST_CASE("2: a tolerance that cannot be promised is refused with the one that can be, and the command to type") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> scene{"run", "hanging", "--set", "rows=4", "--set", "columns=4", "--seconds", "0.1"};
  std::vector<std::string> call = scene;
  call.insert(call.end(), {"--tolerance", "1e-12"});
  const auto refused = test::tyglab(folder.path(), call);
  CHECK(refused.code == 2);
  const std::string typed = "tyglab run hanging --set rows=4 --set columns=4 --seconds 0.1 --tolerance ";
  const auto at = refused.err.find(typed);
  REQUIRE(at != std::string::npos);
  const std::string offered = refused.err.substr(at + typed.size(), refused.err.rfind('.') - at - typed.size());
  call.back() = offered;
  const auto chosen = test::tyglab(folder.path(), call);
  CHECK(chosen.code == 0);
  CHECK(chosen.err.find("--tolerance chose") != std::string::npos);
}

TEST_CASE("0: help of the program and of every command, with an example; version; lists") {
  const test::TemporaryFolder folder;
  check_calls({{{"--help"}, 0, "run"},
               {{"--version"}, 0, "tyglab"},
               {{"run", "--help"}, 0, "xample"},
               {{"render", "--help"}, 0, "xample"},
               {{"presets", "--help"}, 0, "xample"},
               {{"presets", "show", "--help"}, 0, "xample"},
               {{"presets", "check", "--help"}, 0, "xample"},
               {{"labs", "check", "--help"}, 0, "xample"},
               {{"devices", "--help"}, 0, "xample"},
               {{"verify", "--help"}, 0, "xample"},
               {{"presets"}, 0, "denim"},
               {{"labs"}, 0, "01_hooke"},
               {{"run", "hanging", "--dt", "auto", "--steps", "5"}, 0, "--dt auto chose"},
               {{"presets", "show", "denim"}, 0, "\"tyglab_preset\": 1"},
               {{"devices"}, 0, "cpu"}},
              folder.path());
}

TEST_CASE("2: the command line is wrong, --set included") {
  const test::TemporaryFolder folder;
  check_calls(
      {{{"run"}, 2, "PRESET"},
       {{"run"}, 2, "tyglab: PRESET is required"},
       {{"run", "denim", "--nonsense"}, 2, "nonsense"},
       {{"run", "hanging", "--secnds", "2"}, 2, "Did you mean --seconds?"},
       {{"run", "hanging", "--secnds=2"}, 2, "Did you mean --seconds?"},
       {{"bench", "skip", "--quik"}, 2, "Did you mean --quick?"},
       {{"run", "denim", "--steps", "abc"}, 2, "tyglab: --steps: 'abc' is not a whole number"},
       {{"run", "denim", "--steps", "-5"}, 2, "steps"},
       {{"run", "denim", "--steps", "5", "--seconds", "1"}, 2, "steps"},
       {{"run", "denim", "--steps", "1", "--set", "k_s"}, 2, "KEY=VALUE"},
       {{"run", "denim", "--steps", "1", "--set", "k_s=-3"}, 2, "0 to 1e9"},
       {{"run", "denim", "--steps", "1", "--set", "k_x=3"}, 2, "did you mean"},
       {{"run", "denim", "--steps", "1", "--set", "K_S=3"}, 2, "did you mean k_s?"},
       {{"--dt", "0.1", "denim", "--steps", "4"}, 2, "Not expected here: --steps 4."},
       {{"run", "denim", "--steps", "1", "--integrator", "eular"}, 2, "euler"},
       {{"run", "denim", "--steps", "1", "--precision", "half"}, 2, "precision"},
       {{"run", "denim", "--steps", "1", "--engine", "gpu"}, 2, "engine"},
       {{"run", "denim", "--steps", "1", "--dt", "2"}, 2, "--dt 2: dt: 2 is not allowed; allowed: 1e-7 to 1 s"},
       {{"run", "denim", "--seconds", "-1"}, 2, "0 to 1e9 s"},
       {{"run", "denim", "--seconds", "nan"}, 2, "0 to 1e9 s"},
       {{"run", "denim", "--steps", "1.5"}, 2, "not a whole number"},
       {{"run", "denim", "--dt", ""}, 2, "empty"},
       {{"run", "", "--steps", "1"}, 2, "empty"},
       {{"run", "denim", "--steps", "1", "--state", ""}, 2, "empty"},
       {{"run", "denim", "--steps", "1", "--set", "bodies[0]={}"}, 2, "bodies[0].r=0.3"},
       {{"run", "denim", "--steps", "1", "--set", "pins=top"}, 2, "known. Allowed: none"},
       {{"run", "denim", "--steps", "1", "--threads", "0"}, 2, "threads"},
       {{"render", "denim"}, 2, "png"},
       {{"render", "denim", "--png", "a.png", "--view", "6"}, 2, "view"},
       {{"render", "denim", "--png", "a.png", "--size", "wide"}, 2, "size"},
       {{"--size", "320x240", "--frames", "1"}, 2, "at least 480x320"},
       {{"--lab", "02_euler", "--lab-step", "4", "--frames", "1"}, 2, "--lab-step: 4 is not allowed; allowed: 1 to 3"},
       {{"presets", "shwo", "denim"},
        2,
        "'shwo' is not one of its commands: show, notation, check. Did you mean 'show'?"},
       {{"bench", "nonsense"},
        2,
        "tyglab: bench: 'nonsense' is not one of its commands: throughput, accuracy, skip, implicit, contact, "
        "one-weight"},
       {{"bench", "accuracy", "--scene", "tsunami"}, 2, "no such scene; known: one_weight, hanging"},
       {{"bench", "one-weight", "--set", "kind=cloth"}, 2, "mass on a spring"},
       {{"bench", "one-weight", "--set", "dt=1e-6", "--seconds", "100"}, 2, "--seconds"},
       {{"bench"}, 2, "throughput, accuracy, skip, implicit, contact, one-weight"},
       {{"runn", "denim", "--steps", "1"}, 2, "Did you mean 'run'?"}},
      folder.path());
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("2: an option that would do nothing, or outputs that would be one file") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "own.json", preset_to_json({}));
  check_calls({{{"run", "hanging", "--engine", "foo", "--steps", "1"}, 2, "opencl:N, plain and auto"},
               {{"run", "denim", "--steps", "1", "--series-every", "5"}, 2, "--series F.csv"},
               {{"run", "denim", "--steps", "1", "--fps", "5"}, 2, "--obj, --pc2"},
               {{"run", "missing.json", "--engine", "auto", "--fps", "5"}, 2, "--obj, --pc2"},
               {{"run", "denim", "--integrator", "verlet", "--set", "integrator=rk4"}, 2, "leave one of the two out"},
               {{"run", "denim", "--dt", "0.001", "--set", "solver.dt=0.002"}, 2, "--dt and --set dt=…: leave one"},
               {{"run", "denim", "--steps", "1", "--series", "t.csv", "--series-every", "1", "--fps", "5"}, 2, "--fps"},
               {{"run", "denim", "--steps", "1", "--state", "-", "--json", "-"}, 2, "both go to standard output"},
               {{"run", "denim", "--steps", "1", "--state", "a", "--series", "./a"}, 2, "both go to"},
               {{"run", "own.json", "--steps", "1", "--json", "own.json"}, 2, "would overwrite the preset"},
               {{"run", "denim", "--steps", "1", "--obj", "-"}, 2, "name a folder"},
               {{"render", "denim", "--png", "-", "--fps", "5"}, 2, "name a folder"},
               {{"--screenshot", "a.png"}, 2, "--frames"},
               {{"--session-report", "-"}, 2, "name a file"}},
              folder.path());
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("3: a preset is wrong or missing") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "wrong.json", "{\n\"forces\": {\n\"k_s\": -1}}");
  test::write_file(folder / "not.json", "k_s = 5");
  test::write_file(folder / "comma.json", "{\n\"name\": \"a\"\n\"kind\": 5}");
  check_calls({{{"run", "wrong.json", "--steps", "1"}, 3, "wrong.json:3: forces.k_s"},
               {{"run", "not.json", "--steps", "1"}, 3, "not.json:1"},
               {{"run", "comma.json", "--steps", "1"}, 3, "comma.json:3: column 1: a comma is missing"},
               {{"run", "missing.json", "--steps", "1"}, 3, "missing.json"},
               {{"run", "demin", "--steps", "1"}, 3, "denim"},
               {{"render", "wrong.json", "--png", "a.png"}, 3, "forces.k_s"},
               {{"presets", "check", "wrong.json"}, 3, "forces.k_s"},
               {{"labs", "check", "missing.md"}, 3, "missing.md"},
               {{"presets", "check", "missing.json"}, 3, "missing.json"},
               {{"presets", "show", "demin"}, 3, "denim"},
               {{"presets", "check", "demin"}, 3, "denim"},
               {{"runn"}, 3, "Did you mean 'run'?"},
               {{"run", "nothing"}, 3, "file. The shipped presets are bias, bounce, bow, "}},
              folder.path());
  test::write_file(folder / "right.json", preset_to_json({}));
  check_calls({{{"presets", "check", "right.json"}, 0, "right.json"},
               {{"presets", "check", "denim"}, 0, "denim is a valid preset"}},
              folder.path());
}

TEST_CASE("3: the program's data is missing, also where the command line is wrong") {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "bin");
  std::filesystem::copy(test::binary, folder / "bin/tyglab");
  for (const char* option : {"--bogus", "--help"}) {
    const auto outcome = test::run(folder.path(), {(folder / "bin/tyglab").string(), "rum", option});
    CHECK(outcome.code == (std::string(option) == "--help" ? 0 : 3));
    CHECK(test::lines(outcome.err).size() == (outcome.code == 0 ? 0 : 1));
  }
}

TEST_CASE("4: run and render diverge; what they had is written, and when, where and why is said") {
  const test::TemporaryFolder folder;
  check_calls({{{"run", "explodes", "--seconds", "60", "--state", "s.csv", "--json", "r.json", "--obj", "frames"},
                4,
                "diverged at t ="},
               {{"render", "explodes", "--seconds", "60", "--png", "p.png", "--size", "160x90"}, 4, "diverged at t ="},
               {{"run", "explodes", "--seconds", "2", "--integrator", "verlet"}, 0, "steps"}},
              folder.path());
  CHECK(test::read_file(folder / "s.csv").starts_with("# tyglab state"));
  CHECK(test::read_file(folder / "s.csv").find("nan") == std::string::npos);
  CHECK(test::read_file(folder / "s.csv").find("inf") == std::string::npos);
  CHECK(test::read_file(folder / "r.json").find("\"status\": \"diverged\"") != std::string::npos);
  CHECK(test::read_file(folder / "p.png").starts_with("\x89PNG"));
  CHECK_FALSE(fs::is_empty(folder / "frames"));
}

/// Fails where a number of these files is none.
void check_finite(const fs::path& folder, std::initializer_list<const char*> files) {
  for (const char* file : files) {
    CAPTURE(std::string(file));
    std::string text = test::read_file(folder / file);
    if (!std::string_view(file).ends_with(".json")) text.erase(0, text.find('\n'));  // a comment with a name in it
    for (char& c : text) c = char(std::tolower(static_cast<unsigned char>(c)));
    for (const char* word : {",inf", ",-inf", ",nan", ",-nan", " inf", " -inf", " nan", " -nan", "infinity"})
      CHECK(text.find(word) == std::string::npos);
  }
}

TEST_CASE("4: an explosion that leaves no spring whole, and no file holds what is no number") {
  const test::TemporaryFolder folder;
  // What a fuzzer found: k_d is far too large for m and dt, and each step tears what it stretches.
  test::write_file(folder / "torn.json",
                   R"({"tyglab_preset": 1, "name": "torn", "forces": {"k_d": 260909.76923858878, "g": 100},
    "tearing": {"F_max": 89896726.4061411}, "solver": {"integrator": "dopri5"}, "cloth": {"rows": 19, "columns": 13,
    "L": 0.003232098022278961, "initial_stretch": 8.021473187859389, "x_0": [-1000, -1000, 0], "pins": "none"}})");
  const auto with_outputs = [&](std::vector<std::string> run) {
    for (const char* output : {"--state", "s.csv", "--values", "v.csv", "--series", "t.csv", "--ledger", "l.csv",
                               "--json", "r.json", "--pc2", "p.pc2", "--obj", "frames"})
      run.emplace_back(output);
    return run;
  };
  const std::vector<std::string> stretched = {
      "run",   "hanging",   "--set", "F_max=0.1",           "--set",     "k_s=1e6", "--set", "tilt_deg=0",
      "--set", "pins=none", "--set", "initial_stretch=1.5", "--seconds", "0.2"};
  for (const auto& run : {std::vector<std::string>{"run", "torn.json", "--steps", "50"}, stretched}) {
    for (const bool ledger : {true, false}) {
      auto line = with_outputs(run);
      if (!ledger)
        line.erase(std::find(line.begin(), line.end(), "--ledger"), std::find(line.begin(), line.end(), "--json"));
      check_calls({{line, 4, "diverged at t ="}}, folder.path());
      check_finite(folder.path(), {"s.csv", "v.csv", "t.csv", "l.csv", "r.json"});
    }
    CHECK_FALSE(fs::is_empty(folder / "frames"));
  }
}

TEST_CASE("5: the engine asked for is not there") {
  const test::TemporaryFolder folder;
  check_calls(
      {{{"run", "denim", "--steps", "1", "--engine", "opencl:99", "--state", "s.csv"}, 5, "cpu"},
       {{"run", "denim", "--steps", "1", "--engine", "opencl", "--integrator", "xpbd", "--state", "s.csv"}, 5, "cpu"},
       {{"run", "denim", "--steps", "1", "--engine", "cpu:0"}, 2, "opencl:N"},
       {{"run", "denim", "--steps", "1", "--engine", "auto", "--set", "engine=cpu"}, 2, "--set engine"}},
      folder.path());
  CHECK_FALSE(fs::exists(folder / "s.csv"));
}

TEST_CASE("6: an output cannot be written") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "file", "");
  check_calls({{{"run", "denim", "--steps", "1", "--state", "missing/s.csv"}, 6, "missing"},
               {{"run", "denim", "--steps", "1", "--series", "missing/s.csv"}, 6, "missing"},
               {{"run", "denim", "--steps", "1", "--pc2", "missing/s.pc2"}, 6, "missing"},
               {{"run", "denim", "--steps", "1", "--json", "missing/s.json"}, 6, "missing"},
               {{"run", "denim", "--steps", "1", "--obj", "file/frames"}, 6, "file/frames"},
               {{"run", "denim", "--steps", "100", "--pc2", "/dev/full"}, 6, "/dev/full"},
               {{"render", "denim", "--seconds", "0.01", "--size", "64x64", "--png", "missing/p.png"}, 6, "missing"}},
              folder.path());
}

TEST_CASE("6: whatever goes to standard output and is lost") {
  const test::TemporaryFolder folder;
  for (const char* words :
       {"--help", "--version", "run --help", "presets", "presets show denim", "presets notation", "devices",
        "run hanging --steps 1", "run hanging --steps 1 --json -", "run hanging --steps 1 --series -",
        "run hanging --steps 1 --pc2 -", "render hanging --seconds 0 --size 16x16 --png -"}) {
    CAPTURE(std::string(words));
    for (const char* nowhere : {" >/dev/full", " >&-"}) {
      const auto outcome =
          test::run(folder.path(), {"/bin/sh", "-c", std::string(test::binary) + " " + words + nowhere});
      CHECK(outcome.code == 6);
      CHECK(outcome.err.find("standard output") != std::string::npos);
    }
  }
}

TEST_CASE("6: a reader of standard output that has had enough ends the run, which says so") {
  const test::TemporaryFolder folder;
  for (const char* words : {"run hanging --seconds 100000 --series - --series-every 1",
                            "run hanging --set rows=200 --set columns=200 --steps 1 --state -", "presets notation"}) {
    CAPTURE(std::string(words));
    // The reader is gone before the first byte comes.
    const auto outcome = test::run(folder.path(), {"/bin/sh", "-c",
                                                   std::string("{ sleep 0.3; ") + test::binary + " " + words +
                                                       "; echo $? > code; } | true; "
                                                       "while [ ! -s code ]; do sleep 0.1; done"});
    CHECK(test::read_file(folder / "code") == "6\n");
    CHECK(outcome.err.find("standard output: its reader has closed it") != std::string::npos);
    fs::remove(folder / "code");
  }
}

TEST_CASE("6: a file that grows beyond the limit of the shell leaves nothing behind") {
  const test::TemporaryFolder folder;
  const std::string call = "ulimit -f 4; " + std::string(test::binary) + " run hanging --steps 1 --state s.csv";
  const auto outcome = test::run(folder.path(), {"/bin/sh", "-c", call});
  CHECK(outcome.code == 6);
  CHECK(outcome.err.find("s.csv: cannot be written") != std::string::npos);
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("6: a temporary file that cannot be written is named by its folder, with a way without it") {
  const test::TemporaryFolder folder;
  const std::string call = "ulimit -f 4; " + std::string(test::binary) + " run hanging --steps 1 --pc2 - | cat >&2";
  const auto outcome = test::run(folder.path(), {"/bin/bash", "-o", "pipefail", "-c", call});
  CHECK(outcome.code == 6);
  CHECK(outcome.err.find("collected in a temporary file in /") != std::string::npos);
  CHECK(outcome.err.find("name a file instead of -") != std::string::npos);
}

TEST_CASE("a file does not take the place of a closed standard output") {
  const test::TemporaryFolder folder;
  test::run(folder.path(), {"/bin/sh", "-c", std::string(test::binary) + " run hanging --steps 1 --series t.csv >&-"});
  const auto rows = test::lines(test::read_file(folder / "t.csv"));
  REQUIRE(rows.size() == 3);
  CHECK(rows.back().starts_with("0,"));
}

TEST_CASE("130: Ctrl-C while a huge cloth is built ends at once, with a sentence") {
  const test::TemporaryFolder folder;
  const auto outcome = test::tyglab_interrupted(
      folder.path(),
      {"run", "hanging", "--set", "rows=4096", "--set", "columns=4096", "--steps", "100000", "--state", "s.csv"}, 0.5);
  CHECK(outcome.code == 130);
  CHECK(outcome.err.find("Interrupted") != std::string::npos);
}

TEST_CASE("130: of a large cloth what takes long to show is left out after Ctrl-C") {
  const test::TemporaryFolder folder;
  const std::vector<std::string> scene{"hanging", "--set", "rows=520", "--set", "columns=500", "--seconds", "1000"};
  const auto call = [&](std::vector<std::string> command, const std::vector<std::string>& more) {
    command.insert(command.end(), scene.begin(), scene.end());
    command.insert(command.end(), more.begin(), more.end());
    return command;
  };
  const auto outcome =
      test::tyglab_interrupted(folder.path(), call({"run"}, {"--state", "s.csv", "--series", "t.csv", "--json", "j"}),
                               0.5, SIGINT, folder / "t.csv.incomplete");
  CHECK(outcome.code == 130);
  CHECK_MESSAGE(outcome.err.find("The last state was left out") != std::string::npos, outcome.err);
  CHECK_MESSAGE(outcome.out.find("Wrote t.csv.incomplete, j.") != std::string::npos, outcome.out);
  CHECK_FALSE(fs::exists(folder / "s.csv"));
  CHECK(test::read_file(folder / "j").find("\"interrupted\"") != std::string::npos);
  const auto drawn = test::tyglab_interrupted(folder.path(), call({"render"}, {"--png", "a.png"}), 1.5);
  CHECK(drawn.code == 130);
  CHECK_FALSE(fs::exists(folder / "a.png"));
}

TEST_CASE("130: a single step that would take minutes is interrupted, and what was asked for is written") {
  for (const char* integrator : {"dopri5", "implicit_euler"}) {
    CAPTURE(std::string(integrator));
    const test::TemporaryFolder folder;
    const auto outcome = test::tyglab_interrupted(folder.path(), {"run",      "hanging",
                                                                  "--set",    std::string("integrator=") + integrator,
                                                                  "--set",    "rows=300",
                                                                  "--set",    "columns=300",
                                                                  "--set",    "k_s=1e6",
                                                                  "--set",    "dt=0.03",
                                                                  "--set",    "iterations=1000",
                                                                  "--set",    "tolerance=1e-11",
                                                                  "--set",    "precision=double",
                                                                  "--steps",  "100",
                                                                  "--state",  "s.csv",
                                                                  "--json",   "j.json",
                                                                  "--series", "t.csv"},
                                                  1.5, SIGINT, folder / "t.csv.incomplete");
    CHECK(outcome.code == 130);
    CHECK_MESSAGE(
        outcome.err.find(
            "Interrupted; what was written so far has whole rows and frames, and no older file was replaced") !=
            std::string::npos,
        outcome.err);
    const std::string state = test::read_file(folder / "s.csv");
    CHECK(test::lines(state).size() > 90'000);
    CHECK(test::read_file(folder / "j.json").find("\"interrupted\"") != std::string::npos);
    CHECK(outcome.err.find("is complete") == std::string::npos);  // it is not, where it is called incomplete
    CHECK_MESSAGE(outcome.out.find("Wrote t.csv.incomplete, s.csv, j.json.") != std::string::npos, outcome.out);
  }
}

}  // namespace tyglab::exit_codes_test
