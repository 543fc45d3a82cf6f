#include "app/process/process.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>

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

}  // namespace tyglab
