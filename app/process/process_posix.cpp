
#include "app/process/process.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>

namespace tyglab {

void secure_standard_streams() {
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  // Descriptors are given out from the lowest: each that was free is taken until the first beyond the three. For
  // reading alone, so that what is written to it fails and is reported.
  int descriptor = 0;
  do {
    descriptor = ::open("/dev/null", O_RDONLY);
  } while (descriptor >= 0 && descriptor <= STDERR_FILENO);
  if (descriptor > STDERR_FILENO) ::close(descriptor);
}

std::vector<std::string> program_arguments(int argc, char** argv) {
  return {argv + std::min(argc, 1), argv + argc};
}

bool display_is_named() {
  return std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
}

void leave_own_console() {}

void show_last_words(int) {}

void end_at_once(std::string_view sentence, int exit_code) {
  // Where stderr is gone too there is nobody left to tell.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, sentence.data(), sentence.size());
  ::_exit(exit_code);
}

namespace {

constexpr int exit_no_engine = 5;  // ExitCode of app/cli/command_line.h
constexpr std::array<int, 5> crashes{SIGSEGV, SIGBUS, SIGABRT, SIGILL, SIGFPE};

// A signal handler reaches nothing but globals, and allocates nothing.
std::array<char, 300> last_sentence;
std::size_t last_sentence_size = 0;
bool explains = false;

std::optional<rlim_t> memory_limit() {
  rlimit limit = {};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

extern "C" void end_with_sentence(int) {
  end_at_once({last_sentence.data(), last_sentence_size}, exit_no_engine);
}

/// Some drivers call exit() where they are refused memory.
void explain_exit() {
  if (explains) end_with_sentence(0);
}

}  // namespace

std::string memory_limit_words() {
  const auto limit = memory_limit();
  if (!limit) return {};
  return " This process may use " + std::to_string(*limit >> 20) +
         " MB of memory at most (ulimit -v); raise that limit, or use less memory.";
}

CrashExplainer::CrashExplainer() {
  if (!memory_limit()) return;
  last_sentence_size = std::size_t(std::snprintf(
      last_sentence.data(), last_sentence.size(),
      "tyglab: Crashed, as graphics and OpenCL drivers do when memory is denied.%s\n", memory_limit_words().c_str()));
  for (const int signal : crashes) std::signal(signal, end_with_sentence);
  explains = std::atexit(explain_exit) == 0;
}

CrashExplainer::~CrashExplainer() {
  leave_crashes_to_parent();
}

void leave_crashes_to_parent() {
  explains = false;
  for (const int signal : crashes) std::signal(signal, SIG_DFL);
}

}  // namespace tyglab
