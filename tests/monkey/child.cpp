#include "tests/monkey/child.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace tyglab::monkey {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void become(const std::vector<std::string>& arguments, const fs::path& log) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  dup2(file, STDOUT_FILENO), dup2(file, STDERR_FILENO);
  std::vector<char*> words;
  std::string self = "/proc/self/exe";
  words.push_back(self.data());
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  execv(self.c_str(), words.data());
  _exit(127);
}

/// "heap-use-after-free … in Rewind::look": what a sanitizer, an assertion or the monkey itself said, without
/// addresses.
std::string said(const fs::path& log) {
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    for (const std::string_view start : {"FINDING: ", "SUMMARY: "})
      if (line.starts_with(start)) return line.substr(start.size());
    if (line.find("Assertion") != line.npos || line.find("runtime error: ") != line.npos) return line;
  }
  return {};
}

}  // namespace

Ending run_child(const std::vector<std::string>& arguments, const fs::path& log, bool shown) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::string("no process can be started: ") + std::strerror(errno));
  if (child == 0) become(arguments, log);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (shown) {
    std::ifstream in(log);
    std::cout << in.rdbuf() << std::flush;
    std::cout.clear();
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {true, {}};
  std::string why = said(log);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) why = "no frame came any more";
  if (why.empty() && WIFSIGNALED(status)) why = std::string("ended by signal ") + strsignal(WTERMSIG(status));
  if (why.empty()) why = "ended with exit code " + std::to_string(WEXITSTATUS(status));
  return {false, why};
}

}  // namespace tyglab::monkey
