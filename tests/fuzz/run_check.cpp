#include "tests/fuzz/run_check.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "core/io/preset_io.h"
#include "tests/fuzz/run_outputs.h"

namespace tyglab::fuzz {
namespace fs = std::filesystem;
namespace {

// The machine may be busy with other things, and a signal waits for its turn as everything does.
constexpr double patience = 20;
constexpr double start_seconds = 10;                 // to load the program
constexpr double driver_bytes = 5e8;                 // that an OpenCL driver with its compiler takes
constexpr double build_seconds = 200;                // for an OpenCL driver, to build kernels twice
constexpr double stop_seconds = 0.5;                 // that an interrupt takes, as documented
constexpr double address_space = 16.0 * (1u << 30);  // so that a leak ends the run, not the machine

[[noreturn]] void become(const std::string& program, const fs::path& folder, std::vector<std::string> arguments) {
  const rlimit limit{rlim_t(address_space), rlim_t(address_space)};
  ::setrlimit(RLIMIT_AS, &limit);
  const auto open = [&](const char* name, int to) {
    const int file = ::open((folder / name).c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    ::dup2(file, to);
  };
  open("stdout.txt", STDOUT_FILENO), open("stderr.txt", STDERR_FILENO);
  if (::chdir(folder.c_str()) != 0) ::_exit(99);
  std::vector<char*> words{const_cast<char*>(program.c_str())};
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  ::execv(program.c_str(), words.data());
  ::_exit(99);
}

double limit_seconds(const RunCase& one) {
  const bool builds = one.preset.engine == EngineKind::opencl;
  return start_seconds + (builds ? build_seconds : 0) + patience * most_seconds(one);
}

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

RunChecker::RunChecker(std::string program, const fs::path& folder) : program_(std::move(program)) {
  const std::vector<std::string> one{"run", "one_weight", "--steps", "1"};
  base_bytes_ = start(folder, one, start_seconds * patience, {}).peak_bytes;
  const std::vector<std::string> on_device{"run", "one_weight", "--steps", "1", "--engine", "opencl"};
  has_opencl_ = start(folder, on_device, build_seconds, {}).code == 0;
}

/// The most that this process has taken, with which a forked one begins to be counted.
double own_peak_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

std::string file_text(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

RunExit RunChecker::start(const fs::path& folder, const std::vector<std::string>& arguments, double seconds,
                          std::optional<double> interrupt_after) const {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const pid_t child = ::fork();
  if (child == 0) become(program_, folder, arguments);
  RunExit exit;
  std::optional<Clock::time_point> interrupted;
  int status = 0;
  rusage usage{};
  while (::wait4(child, &status, WNOHANG, &usage) == 0) {
    const bool due = interrupt_after && since(begin) >= *interrupt_after;
    if (!interrupted && (due || since(begin) > seconds)) {
      exit.overdue = !due;
      ::kill(child, SIGINT);
      interrupted = Clock::now();
    }
    if (interrupted && since(*interrupted) > stop_seconds * patience) {
      exit.hung = true;
      ::kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  if (interrupted) exit.stop_seconds = since(*interrupted);
  if (WIFEXITED(status)) exit.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) exit.signal = WTERMSIG(status);
  exit.peak_bytes = 1024.0 * double(usage.ru_maxrss);
  return exit;
}

std::optional<Finding> RunChecker::check(const RunCase& one, const fs::path& folder) const {
  fs::remove_all(folder);
  fs::create_directories(folder);
  save_preset(one.preset, folder / "preset.json");
  const RunExit exit = start(folder, arguments_of(one), limit_seconds(one), one.interrupt_after);
  if (exit.hung)
    return Finding{"hang", "did not end within " + std::to_string(stop_seconds * patience) + " s of SIGINT"};
  // Before the program has begun to handle it, a signal does what it does to any program.
  if (exit.signal == SIGINT && one.interrupt_after) return {};
  if (exit.signal != 0) return Finding{"crash", "ended by signal " + std::to_string(exit.signal)};
  if (exit.overdue) return Finding{"slow", "took longer than its work can take"};
  const bool on_device = one.preset.engine == EngineKind::opencl;
  const double allowed =
      most_bytes(one) + 1.2 * std::max(base_bytes_, own_peak_bytes()) + (on_device ? driver_bytes : 0);
  if (exit.peak_bytes > allowed)
    return Finding{"memory", "took " + std::to_string(exit.peak_bytes / 1e6) + " MB, and " +
                                 std::to_string(allowed / 1e6) + " MB are allowed"};
  if (auto finding = outputs_finding(one, exit.code, folder)) return finding;
  return one.twin ? check_twin(one, folder) : std::nullopt;
}

/// What is watched, and how many threads there are, changes nothing.
std::optional<Finding> RunChecker::check_twin(const RunCase& one, const fs::path& folder) const {
  RunCase other = one;
  other.outputs.clear();
  other.threads = one.threads == 1 ? 2 : 1;
  const fs::path beside = folder / "twin";
  fs::create_directories(beside);
  save_preset(other.preset, beside / "preset.json");
  start(beside, arguments_of(other), limit_seconds(other), {});
  if (file_text(beside / "state.csv") == file_text(folder / "state.csv")) return {};
  return Finding{"twin", "without outputs and with other threads it ends otherwise"};
}

}  // namespace tyglab::fuzz
