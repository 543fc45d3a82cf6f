#include "app/process/child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "app/process/memory_limit.h"

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

/// Whether a process ends in that time.
bool ends_within(pid_t process, double seconds) {
  // By its number, since glibc 2.36 declares its function for C alone.
  const int descriptor = int(::syscall(SYS_pidfd_open, process, 0));
  if (descriptor < 0) return true;  // an old Linux: it is waited for
  pollfd end{descriptor, POLLIN, 0};
  const int ready = ::poll(&end, 1, int(1e3 * seconds));
  ::close(descriptor);
  return ready != 0;
}

}  // namespace

Child::Child(const Work& work, const ChildOptions& options) : most_seconds_(options.most_seconds) {
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
  most_seconds_ = from.most_seconds_, start_ = from.start_, result_ = std::move(from.result_);
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

bool Child::overdue() const {
  return most_seconds_ > 0 && age() > most_seconds_;
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

ChildExit run_in_child(const Child::Work& work, const ChildOptions& options) {
  Child child(work, options);
  pollfd pipe{child.pipe(), POLLIN, 0};
  constexpr int milliseconds = 200;
  while (!child.overdue())
    if (::poll(&pipe, 1, milliseconds) > 0 && !child.read()) break;
  return child.end();
}

ProgramExit run_program(const std::string& path, std::vector<std::string> arguments, const ProgramOptions& options) {
  std::vector<char*> words;
  words.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  const int output = ::memfd_create("output", MFD_CLOEXEC);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  if (options.input >= 0)
    posix_spawn_file_actions_adddup2(&files, options.input, STDIN_FILENO);
  else
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    if (output >= 0)
      posix_spawn_file_actions_adddup2(&files, output, stream);
    else
      posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_WRONLY, 0);
  }
  ProgramExit exit;
  pid_t process = -1;
  const int problem = ::posix_spawn(&process, path.c_str(), &files, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (problem == 0) {
    exit.timed_out = options.most_seconds > 0 && !ends_within(process, options.most_seconds);
    if (exit.timed_out) ::kill(process, SIGKILL);
    const int status = status_of(process);
    if (WIFEXITED(status)) exit.code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) exit.signal = WTERMSIG(status);
  }
  if (output >= 0) {
    std::array<char, 65536> bytes;
    const ssize_t count = ::pread(output, bytes.data(), bytes.size(), 0);
    exit.output.assign(bytes.data(), std::size_t(std::max(count, ssize_t(0))));
    ::close(output);
  }
  return exit;
}

}  // namespace tyglab
