
#include "app/process/child.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>
#include <filesystem>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "app/process/program_run.h"
#include "core/engines/opencl/opencl_devices.h"
#include "core/io/output_file.h"

namespace tyglab {
namespace {

struct RunningCase {
  std::int64_t number;
  Child child;
};

RunningCase start_case(const ChildCases& cases, std::int64_t number) {
  return {number, Child([&cases, number] { return cases.work(number); },
                        {.most_seconds = 10 * cases.most_processor_seconds,
                         .most_processor_seconds = cases.most_processor_seconds})};
}

/// Waits a moment for any of them; which have something to say.
std::vector<bool> wait_for(const std::vector<RunningCase>& running) {
  std::vector<pollfd> pipes;
  pipes.reserve(running.size());
  for (const RunningCase& one : running) pipes.push_back({one.child.pipe(), POLLIN, 0});
  constexpr int milliseconds = 200;
  poll(pipes.data(), pipes.size(), milliseconds);
  std::vector<bool> speak;
  speak.reserve(pipes.size());
  for (const pollfd& pipe : pipes) speak.push_back((pipe.revents & (POLLIN | POLLHUP | POLLERR)) != 0);
  return speak;
}

}  // namespace

void run_child_cases(const ChildCases& cases) {
  std::vector<RunningCase> running;
  std::map<std::int64_t, ChildExit> waiting;  // ended before one with a lower number
  std::int64_t next = cases.from, reported = cases.from;
  const std::int64_t last = cases.from + cases.count;
  // Where it is to stop, those that run are killed.
  while ((!running.empty() || next < last) && !cases.stop()) {
    while (int(running.size()) < cases.at_a_time && next < last) running.push_back(start_case(cases, next++));
    const std::vector<bool> speaks = wait_for(running);
    for (std::size_t n = running.size(); n-- > 0;) {
      RunningCase& one = running[n];
      if (!one.child.overdue() && (!speaks[n] || one.child.read())) continue;
      waiting[one.number] = one.child.end();
      running.erase(running.begin() + std::ptrdiff_t(n));
    }
    for (auto first = waiting.find(reported); first != waiting.end(); first = waiting.find(++reported)) {
      cases.ended(reported, first->second);
      waiting.erase(first);
    }
  }
}

void probe_drivers_in_child() {
  set_driver_probe([](const std::function<void()>& ask) {
    constexpr double most_seconds = 30;  // a driver that hangs is as bad
    try {
      const auto work = [&]() noexcept { return ask(), std::string(); };  // what is thrown is a crash too
      const ChildExit exit = run_in_child(work, {.most_seconds = most_seconds, .silent = true});
      return exit.signal == 0 && exit.code == 0;  // some end the process instead
    } catch (const ChildError&) {
      return true;  // nothing is known against them
    }
  });
}

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
