#include "tests/support/files.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <doctest/doctest.h>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>

#include "tests/support/places.h"

namespace tyglab::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string pattern = (fs::temp_directory_path() / "tyglab-test-XXXXXX").string();
  REQUIRE(mkdtemp(pattern.data()) != nullptr);
  path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE_MESSAGE(in.good(), file.string());
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_file(const fs::path& file, std::string_view text) {
  std::ofstream out(file, std::ios::binary);
  out << text;
  REQUIRE_MESSAGE(out.good(), file.string());
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end = text.find(separator); end != text.npos; end = text.find(separator, begin)) {
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.emplace_back(text.substr(begin));
  return parts;
}

std::vector<std::string> lines(std::string_view text) {
  auto result = split(text, '\n');
  if (!result.empty() && result.back().empty()) result.pop_back();
  return result;
}

namespace {

/// What happens in the child after fork(): never returns.
[[noreturn]] void become(const fs::path& folder, const std::vector<std::string>& command, const fs::path& out,
                         const fs::path& err) {
  const int null = open("/dev/null", O_RDONLY);
  const int out_file = open(out.c_str(), O_WRONLY);
  const int err_file = open(err.c_str(), O_WRONLY);
  if (null < 0 || out_file < 0 || err_file < 0 || chdir(folder.c_str()) != 0) _exit(126);
  dup2(null, 0);
  dup2(out_file, 1);
  dup2(err_file, 2);
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  execvp(arguments[0], arguments.data());
  _exit(127);
}

/// Whether the process has become the program and has a function of its own for that signal, or has ended.
bool is_ready_for(pid_t process, int signal) {
  const fs::path about = "/proc/" + std::to_string(process);
  std::error_code ended;
  const fs::path program = fs::read_symlink(about / "exe", ended);
  if (ended) return true;
  if (program == fs::read_symlink("/proc/self/exe")) return false;  // doctest's functions, until it is replaced
  std::ifstream status(about / "status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1) != 0;
  return false;
}

/// Waits, at most a minute, until that is so.
void wait_until(const std::function<bool()>& so) {
  constexpr auto look = std::chrono::milliseconds(10);
  for (int n = 0; n < 6000 && !so(); ++n) std::this_thread::sleep_for(look);
}

Outcome run_and_signal(const fs::path& folder, const std::vector<std::string>& command, double interrupt_after,
                       int signal, const fs::path& file) {
  const TemporaryFolder capture;
  const fs::path out = capture / "out", err = capture / "err";
  for (const fs::path& to : {out, err}) write_file(to, "");
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) become(folder, command, out, err);
  if (interrupt_after > 0) {
    if (signal != SIGKILL) wait_until([&] { return is_ready_for(child, signal); });
    if (!file.empty()) wait_until([&] { return fs::exists(file); });
    std::this_thread::sleep_for(std::chrono::duration<double>(interrupt_after));
    kill(child, signal);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, read_file(out), read_file(err)};
}

}  // namespace

Outcome run(const fs::path& folder, const std::vector<std::string>& command) {
  return run_and_signal(folder, command, 0, 0, {});
}

Outcome tyglab(const fs::path& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), test::binary);
  return run_and_signal(folder, arguments, 0, 0, {});
}

Outcome tyglab_interrupted(const fs::path& folder, std::vector<std::string> arguments, double after_seconds, int signal,
                           const fs::path& file) {
  arguments.insert(arguments.begin(), test::binary);
  return run_and_signal(folder, arguments, after_seconds, signal, file);
}

}  // namespace tyglab::test
