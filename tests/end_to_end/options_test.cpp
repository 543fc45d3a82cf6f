// Options that a command has no use for, and what commands say where they do less than was asked.
#include <doctest/doctest.h>

#include <thread>

#include "core/io/preset_io.h"
#include "tests/support/files.h"
#include "tests/support/places.h"

namespace tyglab::options_test {

using Words = std::vector<std::string>;

/// Runs a command; checks its code, and that it says `says` on stdout or stderr.
test::Outcome check(const test::TemporaryFolder& folder, const Words& words, int code, const std::string& says) {
  std::string line;
  for (const std::string& word : words) line += word + " ";
  CAPTURE(line);
  auto outcome = test::tyglab(folder.path(), words);
  CHECK(outcome.code == code);
  const std::string all = outcome.out + outcome.err;
  CHECK_MESSAGE(all.find(says) != std::string::npos, "\"" << says << "\" is missing in: " << all);
  return outcome;
}

TEST_CASE("experiments on the CPU engine alone refuse another, and say so where the preset names it") {
  const test::TemporaryFolder folder;
  test::write_file(folder / "opencl.json",
                   R"({"tyglab_preset": 1, "kind": "one_weight", "solver": {"engine": "opencl"}})");
  for (const Words& command : {Words{"stability", "map"}, Words{"bench", "convergence"}}) {
    const auto with = [&](const Words& more) {
      Words all = command;
      all.insert(all.end(), more.begin(), more.end());
      all.emplace_back("--quick");
      return all;
    };
    for (const char* engine : {"opencl:99", "opencl", "auto", "nonsense"})
      check(folder, with({"one_weight", "--engine", engine}), 2,
            "--engine " + std::string(engine) + ": this command runs only on the CPU engine");
    for (const char* set : {"engine=opencl", "solver.engine=opencl"})
      check(folder, with({"one_weight", "--set", set}), 2, "--set engine=opencl: this command runs only on the CPU");
    CHECK(check(folder, with({"one_weight", "--engine", "cpu"}), 0, "").err.empty());
    CHECK(check(folder, with({"opencl.json", "--engine", "cpu"}), 0, "").err.empty());
    const auto outcome = check(folder, with({"opencl.json"}), 0, "the preset asks for the engine opencl");
    CHECK(test::lines(outcome.err).size() == 1);
  }
  check(folder, {"bench", "convergence", "one_weight", "--precision", "float"}, 2, "in double");
}

TEST_CASE("--engine: all that is allowed is named") {
  const test::TemporaryFolder folder;
  for (const char* engine : {"auto:0", "cpu:0", "opencl:", "opencl:-1", "opencl:1x", "gpu"})
    check(folder, {"run", "one_weight", "--steps", "1", "--engine", engine}, 2,
          "--engine " + std::string(engine) + ": allowed are cpu, opencl, opencl:N, plain and auto");
  check(folder, {"--engine", "auto:0"}, 2, "allowed are cpu, opencl, opencl:N, plain and auto");
}

TEST_CASE("an option of the window before a command: behind it, or left out where the command has none") {
  const test::TemporaryFolder folder;
  check(folder, {"--size", "640x480", "devices"}, 2, "--size: belongs to the window, and `tyglab devices` does not");
  check(folder, {"--frames", "3", "stability", "map"}, 2, "`tyglab stability map` does not accept it; omit it");
  check(folder, {"--size", "640x480", "render", "one_weight", "--png", "a.png"}, 2, "--size: comes before the command");
  check(folder, {"--dt", "0.1", "run", "one_weight"}, 2, "--dt: comes before the command; put it after the command");
  for (const char* option : {"--size", "--engine"}) check(folder, {option, ""}, 2, "must not be empty");
  check(folder, {"render", "one_weight", "--png", "a.png", "--size", ""}, 2, "--size");
}

TEST_CASE("presets check: valid, but for an engine that does not compute it, in the words with which run refuses") {
  const test::TemporaryFolder folder;
  struct Case {
    std::string engine, integrator, forces, but;
  };
  for (const Case& one :
       {Case{"opencl", "verlet", "", ""},
        {"opencl", "implicit_euler", "", ""},
        {"opencl", "dopri5", "", "The OpenCL engine does not run dopri5"},
        {"opencl", "xpbd", "", "The OpenCL engine does not run xpbd"},
        {"opencl", "verlet", R"("B": 1, "kappa_warp": 3)", "The OpenCL engine does not compute F_curl"},
        {"opencl", "implicit_euler", R"("air_density": 1.2)",
         "The OpenCL engine does not compute F_air with implicit_euler"},
        {"plain", "verlet", R"("B": 1, "kappa_warp": 3)", ""},
        {"plain", "implicit_euler", "", "The plain engine runs explicit methods of fixed dt"}}) {
    CAPTURE(one.engine + " " + one.integrator + " " + one.forces);
    test::write_file(folder / "a.json", R"({"solver": {"engine": ")" + one.engine + R"(", "integrator": ")" +
                                            one.integrator + R"("}, "forces": {)" + one.forces + "}}");
    const auto outcome = check(folder, {"presets", "check", "a.json"}, 0, "a.json is a valid preset");
    CHECK((outcome.out.find("But: ") != std::string::npos) == !one.but.empty());
    CHECK_MESSAGE(outcome.out.find(one.but) != std::string::npos, outcome.out);
    if (!one.but.empty()) check(folder, {"run", "a.json", "--steps", "1"}, 5, one.but);
  }
}

TEST_CASE("a run shorter than half of dt says that it makes no step") {
  const test::TemporaryFolder folder;
  const std::string says = "--seconds 0.1 is less than half a step of dt = 1 s";
  check(folder, {"run", "hanging", "--seconds", "0.1", "--dt", "1"}, 0, says);
  check(folder, {"render", "hanging", "--seconds", "0.1", "--dt", "1", "--size", "64x48", "--png", "a.png"}, 0, says);
  CHECK(check(folder, {"run", "hanging", "--seconds", "0"}, 0, "0 steps").err.empty());
  CHECK(check(folder, {"run", "hanging", "--steps", "0", "--dt", "1"}, 0, "0 steps").err.empty());
}

TEST_CASE("bench convergence without anything to measure says that alone") {
  const test::TemporaryFolder folder;
  const auto outcome = check(folder, {"bench", "convergence", "hanging", "--integrator", "dopri5", "--quick"}, 0,
                             "chooses its own steps");
  CHECK(test::lines(outcome.out).size() == 1);
  CHECK(outcome.out.starts_with("The order cannot be measured: "));
}

TEST_CASE("devices tells how many threads the CPU engine may use") {
  const test::TemporaryFolder folder;
  const unsigned count = std::thread::hardware_concurrency();
  const std::string threads = ", up to " + std::to_string(count) + (count == 1 ? " thread\n" : " threads\n");
  const auto outcome = check(folder, {"devices"}, 0, threads);
  CHECK(outcome.out.find(threads) != outcome.out.rfind(threads));  // float and double
}

TEST_CASE("steps of implicit methods that do not converge are told once, in text and JSON; by default they converge") {
  const test::TemporaryFolder folder;
  const Words stiff{"--steps", "3", "--dt", "0.0166", "--set", "k_s=1e5", "--json", "a.json"};
  for (const char* method : {"implicit_euler", "implicit_midpoint", "tr_bdf2"}) {
    Words words{"run", "hanging", "--integrator", method};
    words.insert(words.end(), stiff.begin(), stiff.end());
    CHECK(check(folder, words, 0, "3 steps to t").err.empty());
    CHECK(test::read_file(folder / "a.json").find("\"unconverged\": 0") != std::string::npos);
    words.insert(words.end(), {"--set", "iterations=1"});
    const auto outcome = check(folder, words, 0, "3 of 3 steps stopped early (up to ");
    // The others: that these steps have added energy, and perhaps that the cloth now crosses itself.
    const bool crosses = outcome.err.find("The cloth passes through itself") != std::string::npos;
    CHECK(test::lines(outcome.err).size() == (crosses ? 3 : 2));
    CHECK(outcome.err.find("times the energy the scene can supply") != std::string::npos);
    CHECK(outcome.err.find("linear solve. Use a smaller dt or more iterations.") != std::string::npos);
    const std::string json = test::read_file(folder / "a.json");
    CHECK(json.find("\"unconverged\": 3") != std::string::npos);
    CHECK(json.find("\"worst_residual\": null") == std::string::npos);
  }
}

TEST_CASE("a precision that is too coarse is said with its cure before the first step, foreseen or met there") {
  const test::TemporaryFolder folder;
  const auto first_line = [&](const Words& settings) {
    Words words{"run", "hanging", "--set", "rows=10", "--set", "columns=9", "--set", "k_b=0", "--steps", "5"};
    words.insert(words.end(), settings.begin(), settings.end());
    const std::string err = check(folder, words, 0, "").err;
    return err.substr(0, err.find('\n'));
  };
  const std::string foreseen = "tyglab: Rounding positions to float changes the force of a spring by up to ";
  for (const char* method : {"implicit_euler", "verlet"}) {
    const Words stiff{"--set", "k_s=1e8", "--set", "F_max=1", "--dt", "1e-6", "--integrator", method};
    CHECK(first_line(stiff).starts_with(foreseen + "12 N here, more than F_max: springs tear by rounding alone."));
  }
  CHECK(first_line({"--set", "k_s=1e7", "--dt", "0.02", "--integrator", "tr_bdf2"}).starts_with(foreseen));
  // Not foreseen, since nothing hangs at first: said with the first step that rounding keeps from converging.
  const std::string err = check(folder,
                                {"run", "sphere", "--set", "k_s=1e4", "--set", "k_b=0", "--dt", "0.01", "--steps", "8",
                                 "--integrator", "implicit_midpoint"},
                                0, "")
                              .err;
  CHECK(err.starts_with("tyglab: Forces do not balance in 1 of 1 step (up to "));
  CHECK(err.find("8 of 8 steps") != std::string::npos);
  CHECK(first_line({"--set", "k_s=1e7", "--dt", "0.02", "--integrator", "tr_bdf2", "--precision", "double"}).empty());
  CHECK(first_line({"--set", "k_s=1e3", "--dt", "0.02", "--integrator", "tr_bdf2"}).empty());
}

TEST_CASE("the work of solving is in JSON for every method that solves, whichever of its counts is 0") {
  const test::TemporaryFolder folder;
  const auto solves = [&](const char* method, const char* steps) {
    check(folder,
          {"run", "hanging", "--set", "rows=6", "--set", "columns=6", "--integrator", method, "--steps", steps,
           "--json", "a.json"},
          0, "");
    return test::read_file(folder / "a.json").find("\"solves\": null") == std::string::npos;
  };
  for (const char* method : {"implicit_euler", "vbd", "projective_dynamics", "damped_verlet"}) {
    CAPTURE(std::string(method));
    CHECK(solves(method, "0"));
    CHECK(solves(method, "2"));
  }
  for (const char* method : {"verlet", "xpbd", "dopri5"}) CHECK_FALSE(solves(method, "2"));
}

TEST_CASE("a file whose name is not UTF-8 is named in JSON as far as it can be") {
  const test::TemporaryFolder folder;
  check(folder, {"run", "hanging", "--steps", "1", "--state", "\xff.csv", "--json", "a.json"}, 0, "Wrote");
  CHECK(test::read_file(folder / "a.json").find("\xEF\xBF\xBD.csv") != std::string::npos);
}

TEST_CASE("a preset may be a link wherever it is read") {
  const test::TemporaryFolder folder;
  check(folder, {"presets", "show", "#flag&k_s=77"}, 0, "\"k_s\": 77");
  check(folder, {"presets", "check", "https://example.org/?embed&preset=flag#k_s=77"}, 0, "is a valid preset: Flag");
  check(folder, {"presets", "check", "#flag&k_s=-1"}, 3, "k_s=-1");
}

TEST_CASE("an output does not replace the texture that is read, nor take an option for its name") {
  const test::TemporaryFolder folder;
  std::filesystem::copy_file(std::string(test::source_dir) + "/textures/linen.png", folder / "a.png");
  const std::string image = test::read_file(folder / "a.png");
  check(folder, {"render", "hanging", "--seconds", "0.01", "--set", "texture=a.png", "--png", "a.png"}, 2,
        "--png a.png: would overwrite the texture that is read");
  CHECK(test::read_file(folder / "a.png") == image);
  check(folder, {"run", "hanging", "--steps", "1", "--state", "--json"}, 2, "--json looks like an option");
  CHECK_FALSE(std::filesystem::exists(folder / "--json"));
  check(folder, {"run", "hanging", "--steps", "1", "--state", "./--json"}, 0, "Wrote ./--json");
}

TEST_CASE("a picture goes into a device as one file") {
  const test::TemporaryFolder folder;
  const Words words{"render", "hanging", "--seconds", "0.01", "--size", "64x48", "--png"};
  const auto into = [&](const char* device) {
    Words all = words;
    all.emplace_back(device);
    return all;
  };
  check(folder, into("/dev/null"), 0, "Wrote /dev/null");
  check(folder, into("/dev/full"), 6, "/dev/full: cannot be written: No space left on device");
}

TEST_CASE("a mass on a spring has no cloth to color, and a missing texture is reported with its key") {
  const test::TemporaryFolder folder;
  check(folder, {"render", "one_weight", "--color", "strain", "--png", "a.png"}, 2, "without a cloth to color");
  const Words missing{"render", "hanging", "--seconds", "0.01", "--set", "texture=nope.png", "--png", "a.png"};
  const auto outcome = check(folder, missing, 0, "Wrote");
  CHECK(outcome.err.find("view.texture: the cloth is drawn without its image") != std::string::npos);
}

TEST_CASE("a step's time can be limited where it can end early, and is told with what that left") {
  const test::TemporaryFolder folder;
  const Words stiff{"run", "hanging", "--steps", "3", "--dt", "0.0166", "--set", "k_s=1e5", "--json", "a.json"};
  const auto with = [&](const Words& more) {
    Words words = stiff;
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const auto outcome = check(folder, with({"--integrator", "implicit_euler", "--step-limit", "0.01"}), 0, "3 steps to");
  CHECK(outcome.err.find("3 of 3 steps stopped early (up to ") != std::string::npos);
  CHECK(outcome.err.find("The time limit ended them (the longest took ") != std::string::npos);
  CHECK(test::read_file(folder / "a.json").find("\"ended_early\": 3") != std::string::npos);
  check(folder, with({"--integrator", "tr_bdf2", "--step-limit", "1"}), 2,
        "a step of tr_bdf2 amplifies the part that it leaves unsolved");
  check(folder, with({"--integrator", "verlet", "--step-limit", "1"}), 2, "a step of verlet always does the same work");
  check(folder, with({"--step-limit", "0"}), 2, "--step-limit");
  check(folder, {"run", "one_weight", "--steps", "3", "--integrator", "implicit_euler", "--step-limit", "1"}, 2,
        "a mass on a spring is solved at once");
}

TEST_CASE("a ledger does not change when a run diverges") {
  const test::TemporaryFolder folder;
  for (const Words& more : {Words{}, Words{"--ledger", "a.csv"}}) {
    Words words{"run", "explodes", "--steps", "100"};
    words.insert(words.end(), more.begin(), more.end());
    check(folder, words, 4, "(step 64)");
  }
}

TEST_CASE("help names choices once, and what is refused comes first") {
  const test::TemporaryFolder folder;
  CHECK(check(folder, {"--help"}, 0, "--effects auto|all|few").out.find('{') == std::string::npos);
  CHECK(check(folder, {"render", "--help"}, 0, "--color tension|").out.find('{') == std::string::npos);
  CHECK(check(folder, {"bench", "skip", "--help"}, 0, "--precision").out.find('{') == std::string::npos);
  check(folder, {"run", "denim", "--bogus"}, 2, "tyglab: Not expected here: --bogus.");
  check(folder, {"run", "denim", "--set", "rows=1e9"}, 2, "allowed: 2 to 4096");
  check(folder, {"run", "denim", "--set", "rows=1.5"}, 2, "allowed: 2 to 4096");
  check(folder, {"run", "denim", "--set", "rows=9999999999999"}, 2, "rows: 9999999999999 is not allowed");
}

TEST_CASE("run and presets check say in plain words that a preset's image is damaged") {
  const test::TemporaryFolder folder;
  Preset preset;
  preset.texture = "a.png";
  test::write_file(folder / "a.json", preset_to_json(preset));
  for (const std::string& bytes :
       {std::string("\x89PNG\r\n\x1a\n1234"), std::string("no picture"), std::string("BM")}) {
    test::write_file(folder / "a.png", bytes);
    for (const Words& call : {Words{"run", "a.json", "--steps", "1"}, Words{"presets", "check", "a.json"}}) {
      const auto outcome = check(folder, call, 0, "tyglab: view.texture: the cloth would be drawn without its image: ");
      CHECK(test::lines(outcome.err).size() == 1);
      const bool plain = outcome.err.find("(it is ") != std::string::npos;
      CHECK_MESSAGE(plain, outcome.err);
    }
  }
}

}  // namespace tyglab::options_test
