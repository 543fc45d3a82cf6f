#include "app/process/memory_limit.h"

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <optional>

namespace tyglab {
namespace {

constexpr int exit_no_engine = 5;  // ExitCode of app/cli/command_line.h
constexpr std::array<int, 5> crashes{SIGSEGV, SIGBUS, SIGABRT, SIGILL, SIGFPE};

// A signal handler reaches nothing but globals, and allocates nothing.
std::array<char, 300> sentence;
std::size_t sentence_size = 0;

std::optional<rlim_t> memory_limit() {
  rlimit limit = {};
  if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

extern "C" void end_with_sentence(int) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, sentence.data(), sentence_size);
  ::_exit(exit_no_engine);
}

}  // namespace

std::string memory_limit_words() {
  const auto limit = memory_limit();
  if (!limit) return {};
  return " This process may use " + std::to_string(*limit >> 20) +
         " MB of memory at most (ulimit -v); raise that limit, or ask for less.";
}

void explain_crashes_under_limit() {
  if (!memory_limit()) return;
  sentence_size = std::size_t(std::snprintf(
      sentence.data(), sentence.size(),
      "tyglab: A crash, as of graphics and OpenCL drivers that are refused memory.%s\n", memory_limit_words().c_str()));
  for (const int signal : crashes) std::signal(signal, end_with_sentence);
}

void leave_crashes_to_parent() {
  for (const int signal : crashes) std::signal(signal, SIG_DFL);
}

}  // namespace tyglab
