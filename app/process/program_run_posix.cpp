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

#include "app/process/program_run.h"

namespace tyglab {
namespace {

/// A file in memory with that text, to be read from its beginning; under 0: none could be made.
int file_of(const std::string& text) {
  const int file = ::memfd_create("input", MFD_CLOEXEC);
  if (file >= 0 && (::write(file, text.data(), text.size()) != ssize_t(text.size()) || ::lseek(file, 0, SEEK_SET) != 0))
    return ::close(file), -1;
  return file;
}

/// Waits for a process to end; its status.
int ended_status(pid_t process) {
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

ProgramExit run_program(const std::string& path, std::vector<std::string> arguments, const ProgramOptions& options) {
  std::vector<char*> words;
  words.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) words.push_back(argument.data());
  words.push_back(nullptr);
  const int output = ::memfd_create("output", MFD_CLOEXEC), input = file_of(options.input);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  if (input >= 0)
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
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
  if (input >= 0) ::close(input);
  if (problem == 0) {
    exit.timed_out = options.most_seconds > 0 && !ends_within(process, options.most_seconds);
    if (exit.timed_out) ::kill(process, SIGKILL);
    const int status = ended_status(process);
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
