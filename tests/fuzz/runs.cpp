// Whole runs of `tyglab run`, valid and extreme, each in a child with limits: tests/fuzz/runs builds and starts this.
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <optional>
#include <string>

#include "core/io/preset_io.h"
#include "tests/fuzz/run_case.h"
#include "tests/fuzz/run_check.h"

namespace tyglab::fuzz {
namespace {

namespace fs = std::filesystem;

struct Options {
  double seconds = 60;
  std::uint64_t seed = 1;
  std::int64_t from = 0;
  std::int64_t cases = std::numeric_limits<std::int64_t>::max();
  fs::path program, findings;
};

double elapsed(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Takes away what is unusual, one thing after the other, while the same thing is found.
RunCase shrunk(const RunChecker& checker, RunCase one, const std::string& kind, const fs::path& folder) {
  constexpr double patience = 60;  // s
  const auto begin = std::chrono::steady_clock::now();
  for (bool simpler = true; simpler;) {
    simpler = false;
    for (const RunCase& next : simpler_cases(one)) {
      if (elapsed(begin) > patience) return one;
      const auto finding = checker.check(next, folder);
      if (!finding || finding->kind != kind) continue;
      one = next, simpler = true;
      break;
    }
  }
  return one;
}

std::string command_line(const RunCase& one) {
  std::string line = "tyglab";
  for (const std::string& argument : arguments_of(one)) line += " " + argument;
  return line;
}

void report(const Options& options, const RunChecker& checker, std::int64_t number, const RunCase& one,
            const Finding& finding, const fs::path& folder) {
  const fs::path kept = options.findings / ("seed" + std::to_string(options.seed) + "-case" + std::to_string(number));
  fs::remove_all(kept);
  fs::create_directories(kept.parent_path());
  fs::copy(folder, kept, fs::copy_options::recursive);
  const std::string again =
      "tests/fuzz/runs --seed " + std::to_string(options.seed) + " --from " + std::to_string(number) + " --cases 1";
  std::ofstream(kept / "command.txt") << command_line(one) << '\n' << again << '\n';
  std::cout << "Finding in case " << number << ", " << finding.kind << ": " << finding.what << "\n  in "
            << kept.string() << "; again: " << again << std::endl;
  if (one.interrupt_after) return;  // what depends on a moment does not come again at once
  const RunCase least = shrunk(checker, one, finding.kind, folder);
  save_preset(least.preset, kept / "shrunk.json");
  std::ofstream(kept / "shrunk.txt") << command_line(least) << '\n';
  std::cout << "  as little as it takes: shrunk.json there, with " << command_line(least) << std::endl;
}

int run(const Options& options) {
  constexpr int most_findings = 10;
  const fs::path folder = options.findings.parent_path() / ("runs." + std::to_string(::getpid()));
  fs::create_directories(folder);
  const RunChecker checker(options.program.string(), folder);
  const auto begin = std::chrono::steady_clock::now();
  std::int64_t tried = 0;
  int findings = 0;
  for (; tried < options.cases && elapsed(begin) < options.seconds && findings < most_findings; ++tried) {
    const RunCase one = run_case(options.seed, options.from + tried, checker.has_opencl());
    if (const auto finding = checker.check(one, folder / "run")) {
      ++findings;
      report(options, checker, options.from + tried, one, *finding, folder / "run");
    }
  }
  fs::remove_all(folder);
  std::cout << "TRIED runs: " << tried << " cases, " << findings << " findings, " << long(elapsed(begin)) << " s\n";
  return findings > 0 ? 1 : 0;
}

/// The whole text as a number of that type.
template <class T>
bool read(const std::string& text, T& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && number >= 0;
}

}  // namespace
}  // namespace tyglab::fuzz

/// PROGRAM FINDINGS [--seconds N] [--seed S] [--from N] [--cases N]
int main(int argc, char** argv) {
  using namespace tyglab::fuzz;
  if (argc < 3) return 2;
  // A shell without job control starts what is in its background with SIGINT ignored, and so would the runs.
  std::signal(SIGINT, SIG_DFL);
  Options options;
  options.program = std::filesystem::absolute(argv[1]), options.findings = std::filesystem::absolute(argv[2]);
  bool limited = false;
  std::optional<double> seconds;
  for (int n = 3; n + 1 < argc; n += 2) {
    const std::string option = argv[n], value = argv[n + 1];
    bool good = false;
    if (option == "--seconds") good = read(value, seconds.emplace());
    if (option == "--seed") good = read(value, options.seed);
    if (option == "--from") good = read(value, options.from);
    if (option == "--cases") good = limited = read(value, options.cases);
    if (!good) return std::cerr << option << " " << value << ": not understood.\n", 2;
  }
  if (limited) options.seconds = std::numeric_limits<double>::infinity();
  options.seconds = seconds.value_or(options.seconds);
  return run(options);
}
