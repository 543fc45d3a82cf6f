// The monkey: uses the whole interface at random, from a seed, and looks whether anything breaks (CONTRIBUTING.md).
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
#include <CLI/CLI.hpp>

#ifdef TYGLAB_ADDRESS_SANITIZED
#include <sanitizer/lsan_interface.h>
#endif

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

#include "app/platform/platform.h"
#include "app/process/child.h"
#include "app/render/gl_objects.h"
#include "tests/monkey/child.h"
#include "tests/monkey/chooser.h"
#include "tests/monkey/player.h"
#include "tests/monkey/shrink.h"
#include "tests/support/sanitized.h"

namespace tyglab::monkey {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double between_samples = 5;  // s, of memory
// Of a session whose cloth stays at 32 x 32, without sanitizers.
constexpr double most_work = 2;      // s of one frame
constexpr double most_memory = 500;  // MB; 240 were seen in eighteen minutes

struct Options {
  unsigned seed = 1;
  double seconds = 0;
  long events = 0;
  fs::path record, replay, shrink;
  double shrink_seconds = 300;
  bool one_cloth = false;
  bool child = false;
};

double since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

/// A line for a script.
void report(const Tally& tally, int findings, double seconds) {
  char line[256];
  std::snprintf(line, sizeof line,
                "TRIED monkey: %ld actions, %d findings, %.0f s, %.0f MB at most, longest frame %.2f s", tally.actions,
                findings, seconds, tally.most_mb, tally.longest_frame_s);
  std::cout << line << std::endl;
}

void describe(const Tally& tally) {
  std::cout << tally.frames << " frames, " << tally.restarts << " restarts of the session; " << tally.passed_over
            << " actions found nothing to act on; the longest frame came with \"" << tally.longest_after << "\"\n";
}

/// What is done is written before it is done, so that it is known whatever it does.
class Recorder {
 public:
  Recorder(const fs::path& file, const Options& options) {
    if (file.empty()) return;
    out_.emplace(file);
    *out_ << "# tyglab_monkey --seed " << options.seed << (options.one_cloth ? " --one-cloth" : "") << std::endl;
    if (!*out_) throw std::runtime_error(file.string() + " cannot be written");
  }
  void add(const Action& action) {
    if (out_) *out_ << action.line() << std::endl;
  }

 private:
  std::optional<std::ofstream> out_;
};

class Memory {
 public:
  explicit Memory(Clock::time_point begun) : begun_(begun) {}
  void look(Tally tally) {
    const double now = since(begun_);
    if (now < next_) return;
    std::cout << "memory: " << int(now) << " s " << int(resident_mb()) << " MB after " << tally.actions << " actions"
              << std::endl;
    next_ = now + between_samples;
  }

 private:
  Clock::time_point begun_;
  double next_ = 0;
};

/// For exports that draw; none where the machine has no OpenGL, and then those fail as a finding.
std::unique_ptr<HeadlessContext> picture_context() {
  try {
    return std::make_unique<HeadlessContext>();
  } catch (const GraphicsError& error) {
    std::cout << "Without pictures: " << error.what() << '\n';
    return nullptr;
  }
}

/// What a session on a small cloth must not need; empty if it does not.
std::string excess(const Tally& tally) {
  if (tally.most_work_s > most_work)
    return "a frame took " + std::to_string(tally.most_work_s) + " s of processor time, on a small cloth";
  if (tally.most_mb > most_memory) return "the session holds " + std::to_string(int(tally.most_mb)) + " MB";
  return {};
}

/// In the process that may crash.
int play(const Options& options) {
  const fs::path record = options.record.empty() ? fs::path() : fs::absolute(options.record);
  const auto actions = options.replay.empty() ? std::vector<Action>() : read_recording(options.replay);
  const auto pictures = picture_context();
  Player player;
  Chooser chooser(options.seed, options.one_cloth);
  Recorder recorder(record, options);
  const Clock::time_point begun = Clock::now();
  Memory memory(begun);
  int findings = 0;
  const bool replays = !options.replay.empty();
  const auto more = [&](long done) {
    if (replays) return done < std::ssize(actions);
    return options.events > 0 ? done < options.events : since(begun) < options.seconds;
  };
  try {
    for (long n = 0; more(n); ++n) {
      const Action action = replays ? actions[std::size_t(n)] : chooser.next(player);
      recorder.add(action);
      player.play(action);
      memory.look(player.tally());
    }
    const std::string problem = options.one_cloth && !test::sanitized ? excess(player.tally()) : "";
    if (!problem.empty()) throw Finding(problem);
  } catch (const std::exception& error) {
    std::cout << "FINDING: " << error.what() << std::endl;
    findings = 1;
  }
  describe(player.tally());
  if (!replays) std::cout << chooser.coverage() << '\n';
  report(player.tally(), findings, since(begun));
  return findings;
}

/// Whether these actions break it as it was broken.
bool breaks(const std::vector<Action>& actions, const fs::path& file, const std::string& how) {
  const fs::path trial = fs::path(file) += ".trial", log = fs::path(file) += ".trial.log";
  write_recording(trial, actions, "a trial of the shrinker");
  return run_child({"--child", "--replay", trial.string()}, log, false).why == how;
}

/// Returns the file of the shortest recording that breaks it in the same way.
void shrink(const fs::path& file, const std::string& how, double seconds) {
  const Clock::time_point begun = Clock::now();
  const auto actions = read_recording(file);
  const auto fails = [&](const std::vector<Action>& some) { return breaks(some, file, how); };
  const auto fewest = shrunk(actions, fails, [&] { return since(begun) > seconds; });
  const fs::path least = fs::path(file) += ".least";
  write_recording(least, fewest, how);
  for (const char* end : {".trial", ".trial.log"}) fs::remove(fs::path(file) += end);
  std::cout << "Shrunk from " << actions.size() << " actions to " << fewest.size() << ": " << least.string() << '\n';
  for (const Action& action : fewest) std::cout << "    " << action.line() << '\n';
  std::cout << "Replay it: " << fs::read_symlink("/proc/self/exe").string() << " --replay " << least.string()
            << std::endl;
}

/// A run in a process of its own, and the shrinking of what it finds.
int supervise(const Options& options, const std::vector<std::string>& arguments) {
  fs::path record = options.record;
  std::vector<std::string> child{"--child"};
  child.insert(child.end(), arguments.begin(), arguments.end());
  if (!options.replay.empty()) record = options.replay;
  if (record.empty()) {
    record = fs::temp_directory_path() / ("tyglab-monkey-" + std::to_string(options.seed) + ".txt");
    child.insert(child.end(), {"--record", record.string()});
  }
  const fs::path log = fs::path(record) += ".log";
  const Clock::time_point begun = Clock::now();
  const Ending ending = run_child(child, log, true);
  if (ending.well) return 0;
  std::cout << "Found: " << ending.why << "\nThe recording is " << record.string() << ", what was said " << log.string()
            << std::endl;
  const double seconds = since(begun);
  if (options.replay.empty()) shrink(record, ending.why, options.shrink_seconds);
  std::ifstream said(log);
  bool told = false;
  for (std::string line; std::getline(said, line);) told |= line.starts_with("TRIED ");
  if (told) return 1;
  Tally tally;  // as much as is known of a process that crashed
  tally.actions = long(read_recording(record).size());
  report(tally, 1, seconds);
  return 1;
}

int shrink_given(const Options& options) {
  const fs::path log = fs::path(options.shrink) += ".log";
  const Ending ending = run_child({"--child", "--replay", options.shrink.string()}, log, false);
  if (ending.well) {
    std::cout << options.shrink.string() << " breaks nothing.\n";
    return 0;
  }
  std::cout << "Found: " << ending.why << '\n';
  shrink(options.shrink, ending.why, options.shrink_seconds);
  return 1;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app{
      "Uses Tyglab's whole interface at random, without a window, and looks whether anything breaks. Exit code 1: it "
      "did; the recording is kept and shrunk."};
  app.add_option("--seed", options.seed, "of everything that is chosen");
  app.add_option("--seconds", options.seconds, "how long");
  app.add_option("--events", options.events, "how many actions");
  app.add_option("--record", options.record, "file for what is done, an action a line");
  app.add_option("--replay", options.replay, "does what a recording says");
  app.add_option("--shrink", options.shrink, "leaves out of a recording what its finding does not need");
  app.add_option("--shrink-seconds", options.shrink_seconds, "how long that may take");
  app.add_flag("--one-cloth", options.one_cloth, "never another number of particles, nor another preset");
  app.add_flag("--child", options.child, "in this process, without shrinking")->group("");
  CLI11_PARSE(app, argc, argv);
  if (!options.shrink.empty()) return shrink_given(options);
  if (options.child) return play(options);
  if (options.replay.empty() && options.seconds <= 0 && options.events <= 0) {
    std::cerr << "tyglab_monkey wants --seconds N, --events N, --replay FILE or --shrink FILE.\n";
    return 2;
  }
  return supervise(options, {argv + 1, argv + argc});
}

}  // namespace
}  // namespace tyglab::monkey

#ifdef TYGLAB_ADDRESS_SANITIZED
/// LLVM, which OpenCL drivers bring along, gives its threads signal stacks that AddressSanitizer takes for its own.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier): its name
  return "use_sigaltstack=0:allocator_may_return_null=1:quarantine_size_mb=64";
}
/// What drivers keep until the process ends is not ours.
extern "C" const char* __lsan_default_suppressions() {  // NOLINT(bugprone-reserved-identifier): its name
  return "leak:libpocl\nleak:libLLVM\nleak:swrast_dri\n";
}
#endif

int main(int argc, char** argv) {
  // What the tests' helpers require is required here too.
  doctest::Context context;
  context.setAsDefaultForAssertsOutOfTestCases();
  context.setAssertHandler([](const doctest::AssertData& data) {
    throw tyglab::monkey::Finding(std::string("required in vain: ") + data.m_expr);
  });
  tyglab::probe_drivers_in_child();
  try {
    const int code = tyglab::monkey::run(argc, argv);
#ifdef TYGLAB_ADDRESS_SANITIZED
    __lsan_do_leak_check();  // as in support/main.cpp
#endif
    return code;
  } catch (const std::exception& error) {
    std::cerr << "tyglab_monkey: " << error.what() << '\n';
    return 2;
  }
}
