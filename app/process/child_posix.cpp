#include "app/process/child.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <utility>

#include "app/process/process.h"

namespace tyglab {
namespace {

[[noreturn]] void fail(const char* what) {
  throw ChildError(std::string("cannot make a ") + what + ": " + std::strerror(errno));
}

void set_up_child(const ChildOptions& options) {
  leave_crashes_to_parent();
  if (options.interruptible)
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
  else
    std::signal(SIGINT, SIG_IGN);  // Ctrl-C reaches it too, but what was begun is finished
  if (!options.silent) return;
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO), ::dup2(nowhere, STDERR_FILENO);
}

bool send(int pipe, const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t now = ::write(pipe, bytes.data() + sent, bytes.size() - sent);
    if (now <= 0) return false;
    sent += std::size_t(now);
  }
  return true;
}

/// The child's whole life.
[[noreturn]] void live(const Child::Work& work, const ChildOptions& options, int pipe) {
  set_up_child(options);
  bool done = false;
  try {
    done = send(pipe, work());
  } catch (...) {  // of which the exit code speaks
  }
  ::_exit(done ? 0 : 1);
}

/// Waits for a process to end; its status.
int status_of(pid_t process) {
  int status = 0;
  while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

}  // namespace

Child::Child(const Work& work, const ChildOptions& options)
    : most_seconds_(options.most_seconds), most_processor_seconds_(options.most_processor_seconds) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("pipe");
  process_ = ::fork();
  if (process_ < 0) {
    ::close(ends[0]), ::close(ends[1]);
    fail("process");
  }
  if (process_ == 0) live(work, options, ends[1]);
  ::close(ends[1]);
  pipe_ = ends[0];
}

Child::Child(Child&& from) noexcept {
  *this = std::move(from);
}

Child& Child::operator=(Child&& from) noexcept {
  std::swap(process_, from.process_), std::swap(pipe_, from.pipe_);
  most_seconds_ = from.most_seconds_, most_processor_seconds_ = from.most_processor_seconds_;
  start_ = from.start_, result_ = std::move(from.result_);
  return *this;
}

Child::~Child() {
  if (process_ < 0) return;
  ::kill(process_, SIGKILL);
  end();
}

bool Child::read() {
  std::array<char, 65536> bytes;
  const ssize_t count = ::read(pipe_, bytes.data(), bytes.size());
  if (count < 0) return errno == EINTR;
  result_.append(bytes.data(), std::size_t(count));
  return count > 0;
}

double Child::processor_seconds() const {
  clockid_t clock;
  timespec time{};
  if (::clock_getcpuclockid(process_, &clock) != 0 || ::clock_gettime(clock, &time) != 0) return 0;
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

bool Child::overdue() const {
  return (most_seconds_ > 0 && age() > most_seconds_) ||
         (most_processor_seconds_ > 0 && processor_seconds() > most_processor_seconds_);
}

ChildExit Child::end() {
  ChildExit exit;
  const bool kills = overdue();
  if (kills) ::kill(process_, SIGKILL);
  ::close(std::exchange(pipe_, -1));
  const int status = status_of(std::exchange(process_, -1));
  exit.seconds = age();
  if (WIFSIGNALED(status)) exit.signal = WTERMSIG(status);
  exit.timed_out = kills && exit.signal == SIGKILL;
  if (WIFEXITED(status)) exit.code = WEXITSTATUS(status);
  if (WIFEXITED(status) && exit.code == 0) exit.result = std::move(result_);
  return exit;
}

std::string signal_words(int signal) {
  return ::strsignal(signal);
}

ChildExit run_in_child(const Child::Work& work, const ChildOptions& options) {
  Child child(work, options);
  pollfd pipe{child.pipe(), POLLIN, 0};
  constexpr int milliseconds = 200;
  while (!child.overdue())
    if (::poll(&pipe, 1, milliseconds) > 0 && !child.read()) break;
  return child.end();
}

}  // namespace tyglab
