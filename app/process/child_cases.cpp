#include "app/process/child_cases.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <stdexcept>
#include <vector>

namespace tyglab {
namespace {

using Clock = std::chrono::steady_clock;

/// A case that is running: its process and the pipe that it speaks into.
struct Child {
  std::int64_t number;
  pid_t process;
  int pipe;
  Clock::time_point start;
  ChildOutcome outcome;
};

[[noreturn]] void fail(const char* what) {
  throw std::runtime_error(std::string("cannot ") + what + " for a case: " + std::strerror(errno));
}

/// The child's whole life. What it says counts only if all of it arrives and it ends well.
[[noreturn]] void live(const ChildCases& cases, std::int64_t number, int pipe) {
  std::signal(SIGINT, SIG_IGN);  // Ctrl-C reaches it too, but what was begun is finished
  int code = 1;
  try {
    const std::string text = cases.work(number);
    std::size_t sent = 0;
    while (sent < text.size()) {
      const ssize_t now = write(pipe, text.data() + sent, text.size() - sent);
      if (now <= 0) break;
      sent += std::size_t(now);
    }
    code = sent == text.size() ? 0 : 1;
  } catch (...) {
    code = 1;
  }
  _exit(code);
}

Child begin(const ChildCases& cases, std::int64_t number) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) fail("make a pipe");
  const pid_t process = fork();
  if (process < 0) {
    close(ends[0]), close(ends[1]);
    fail("make a process");
  }
  if (process == 0) live(cases, number, ends[1]);
  close(ends[1]);
  return {number, process, ends[0], Clock::now(), {}};
}

double age(const Child& child) {
  return std::chrono::duration<double>(Clock::now() - child.start).count();
}

/// Waits for the child's end, and notes how it came.
void end(Child& child) {
  close(child.pipe);
  int status = 0;
  while (waitpid(child.process, &status, 0) < 0 && errno == EINTR) continue;
  child.outcome.seconds = age(child);
  if (WIFSIGNALED(status)) child.outcome.signal = WTERMSIG(status);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) child.outcome.text.clear();
}

/// Reads what there is; false once the child has no more to say.
bool read_from(Child& child) {
  std::array<char, 65536> bytes;
  const ssize_t count = read(child.pipe, bytes.data(), bytes.size());
  if (count < 0) return errno == EINTR;
  child.outcome.text.append(bytes.data(), std::size_t(count));
  return count > 0;
}

}  // namespace

void run_child_cases(const ChildCases& cases) {
  std::vector<Child> running;
  std::map<std::int64_t, ChildOutcome> waiting;  // ended before one with a lower number
  std::int64_t next = cases.from, told = cases.from;
  const std::int64_t last = cases.from + cases.count;
  while (!running.empty() || (next < last && !cases.stop())) {
    while (int(running.size()) < cases.at_a_time && next < last && !cases.stop())
      running.push_back(begin(cases, next++));
    std::vector<pollfd> pipes;
    pipes.reserve(running.size());
    for (const Child& child : running) pipes.push_back({child.pipe, POLLIN, 0});
    constexpr int milliseconds = 200;
    poll(pipes.data(), pipes.size(), milliseconds);
    for (std::size_t n = running.size(); n-- > 0;) {
      Child& child = running[n];
      if (age(child) > cases.most_seconds) child.outcome.timed_out = true, kill(child.process, SIGKILL);
      const bool speaks = (pipes[n].revents & (POLLIN | POLLHUP | POLLERR)) != 0;
      if (!child.outcome.timed_out && (!speaks || read_from(child))) continue;
      end(child);
      waiting[child.number] = child.outcome;
      running.erase(running.begin() + std::ptrdiff_t(n));
    }
    for (auto first = waiting.find(told); first != waiting.end(); first = waiting.find(++told)) {
      cases.ended(told, first->second);
      waiting.erase(first);
    }
  }
}

}  // namespace tyglab
