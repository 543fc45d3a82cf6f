
#include "app/process/child.h"

#include <chrono>
#include <cstdio>
#include <deque>
#include <future>

namespace tyglab {

std::string signal_words(int signal) {
  char words[32];
  std::snprintf(words, sizeof words, "exception 0x%08X", unsigned(signal));
  return words;
}

void run_child_cases(const ChildCases& cases) {
  std::deque<std::future<ChildExit>> running;  // in the order of their numbers
  const auto run = [&cases](std::int64_t number) {
    ChildExit exit;
    const auto start = std::chrono::steady_clock::now();
    try {
      exit.result = cases.work(number);
    } catch (...) {  // of which the exit code speaks
      exit.code = 1;
    }
    exit.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return exit;
  };
  std::int64_t next = cases.from, reported = cases.from;
  const std::int64_t last = cases.from + cases.count;
  while (!running.empty() || (next < last && !cases.stop())) {
    while (int(running.size()) < cases.at_a_time && next < last && !cases.stop())
      running.push_back(std::async(std::launch::async, run, next++));
    if (running.empty()) break;
    cases.ended(reported++, running.front().get());
    running.pop_front();
  }
}

// Drivers are asked here: one that crashes when it is asked for its devices ends the program. What may fail on a
// working device, a program that is built, is tried in a process of its own here too (program_run.h).
void probe_drivers_in_child() {}

std::string print_in_child(void (*print)()) {
  print();
  return {};
}

}  // namespace tyglab
