#include <poll.h>

#include <map>
#include <utility>
#include <vector>

#include "app/process/child.h"
#include "app/process/child_cases.h"

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

}  // namespace tyglab
