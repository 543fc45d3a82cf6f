#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "app/process/child.h"
#include "app/process/print_in_child.h"
#include "app/process/program_trial.h"
#include "core/io/destination.h"
#include "core/io/files.h"

namespace tyglab {
namespace {

/// What a driver prints goes to driver_log().
void send_chatter_to_log() {
  const std::filesystem::path log = driver_log();
  std::error_code error;
  if (!log.empty()) std::filesystem::create_directories(log.parent_path(), error);
  int to = log.empty() ? -1 : ::open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (to < 0) to = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(to, STDERR_FILENO);
  ::close(to);
}

}  // namespace

std::string print_in_child(void (*print)()) {
  flush_standard_output();
  const std::string arrived = "arrived";
  // What is thrown by a driver ends the child like an abort.
  const auto work = [&]() noexcept -> std::string {
    send_chatter_to_log();
    print();
    try {
      flush_standard_output();
    } catch (const OutputError&) {
      return {};
    }
    return arrived;
  };
  try {
    const ChildExit exit = run_in_child(work, {.interruptible = true});  // only this process speaks of Ctrl-C
    if (exit.signal != 0) return signal_words(exit.signal);
    if (exit.code != 0) return "exit code " + std::to_string(exit.code);
    if (exit.result != arrived) throw OutputError("standard output: the list could not be written completely");
    return {};
  } catch (const ChildError&) {
    return print(), std::string();
  }
}

}  // namespace tyglab
