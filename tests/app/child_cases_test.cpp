// Cases in processes of their own: what crashes or hangs becomes a result, and all are told in order.
#include "app/process/child.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <vector>

namespace tyglab::child_cases_test {

struct Told {
  std::int64_t number;
  ChildExit outcome;
};

std::vector<Told> told_by(ChildCases cases) {
  std::vector<Told> told;
  cases.ended = [&](std::int64_t number, const ChildExit& outcome) { told.push_back({number, outcome}); };
  if (!cases.stop) cases.stop = [] { return false; };
  run_child_cases(cases);
  return told;
}

TEST_CASE("what cases say arrives whole and in the order of their numbers") {
  const auto told = told_by({.from = 5, .count = 12, .at_a_time = 3, .work = [](std::int64_t n) {
                               usleep(n % 3 == 0 ? 20000 : 100);  // so that they end in another order
                               return std::string(n == 7 ? 300000 : 1, char('a' + n));
                             }});
  REQUIRE(told.size() == 12);
  for (std::size_t n = 0; n < told.size(); ++n) {
    CHECK(told[n].number == std::int64_t(n) + 5);
    CHECK(told[n].outcome.result == std::string(told[n].number == 7 ? 300000 : 1, char('a' + told[n].number)));
    CHECK(told[n].outcome.signal == 0);
  }
}

TEST_CASE("a case that crashes, hangs or throws is told, and the others go on" * doctest::test_suite("slow")) {
  const auto told =
      told_by({.from = 0, .count = 6, .at_a_time = 2, .most_processor_seconds = 0.1, .work = [](std::int64_t n) {
                 if (n == 1) raise(SIGKILL);
                 for (volatile bool go = n == 2; go;) continue;
                 if (n == 3) throw std::runtime_error("no");
                 if (n == 4) pause();
                 return std::string("done");
               }});
  REQUIRE(told.size() == 6);
  CHECK(told[0].outcome.result == "done");
  CHECK(told[1].outcome.result.empty());
  CHECK(told[1].outcome.signal == SIGKILL);
  CHECK_FALSE(told[1].outcome.timed_out);
  CHECK(told[2].outcome.result.empty());
  CHECK(told[2].outcome.timed_out);
  CHECK(told[3].outcome.result.empty());
  CHECK(told[3].outcome.signal == 0);
  CHECK(told[4].outcome.result.empty());
  CHECK(told[4].outcome.timed_out);
  CHECK(told[5].outcome.result == "done");
}

TEST_CASE("once it is to stop, no case is begun, and those begun are told") {
  int asked = 0;
  const auto told = told_by({.from = 0,
                             .count = 100,
                             .at_a_time = 2,
                             .work = [](std::int64_t) { return std::string("done"); },
                             .stop = [&] { return ++asked > 6; }});
  CHECK(!told.empty());
  CHECK(told.size() < 10);
  for (const Told& one : told) CHECK(one.outcome.result == "done");
}

}  // namespace tyglab::child_cases_test
