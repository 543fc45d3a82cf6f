// A function or a program in a child process: what it returns, and how it ends, is a result.
#include "app/process/child.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>

#include "app/process/program_run.h"

namespace tyglab::child_test {

TEST_CASE("a function's result arrives whole, and its crash, error or hang is told") {
  const std::string large(300000, 'x');
  CHECK(run_in_child([&] { return large; }).result == large);
  CHECK(run_in_child([] { return std::string(); }).code == 0);

  const ChildExit crashed = run_in_child([]() -> std::string { return std::raise(SIGKILL), "no"; });
  CHECK(crashed.signal == SIGKILL);
  CHECK_FALSE(crashed.timed_out);
  CHECK(crashed.result.empty());

  const ChildExit threw = run_in_child([]() -> std::string { throw std::runtime_error("no"); });
  CHECK(threw.signal == 0);
  CHECK(threw.code == 1);
  CHECK(threw.result.empty());

  const ChildExit hung = run_in_child([] { return pause(), std::string("no"); }, {.most_seconds = 0.3});
  CHECK(hung.timed_out);
  CHECK(hung.result.empty());
  CHECK(hung.seconds >= 0.3);
}

TEST_CASE("a limit of processor time counts what a child has computed, not how long it took") {
  const ChildOptions limited{.most_processor_seconds = 0.1};
  CHECK(run_in_child([] { return usleep(300000), std::string("slept"); }, limited).result == "slept");
  const ChildExit hung = run_in_child(
      [] {
        for (volatile bool go = true; go;) continue;
        return std::string("no");
      },
      limited);
  CHECK(hung.timed_out);
  CHECK(hung.result.empty());
}

TEST_CASE("Ctrl-C ends a child only if it is interruptible") {
  const auto interrupted = [](const ChildOptions& options) {
    return run_in_child([] { return std::raise(SIGINT), std::string("went on"); }, options);
  };
  CHECK(interrupted({}).result == "went on");
  CHECK(interrupted({.interruptible = true}).signal == SIGINT);
}

TEST_CASE("a child that nobody waits for is ended") {
  int pipe = -1;
  {
    const Child child([] { return pause(), std::string(); }, {});
    pipe = child.pipe();
    CHECK(pipe >= 0);
  }
  char byte = 0;
  CHECK(read(pipe, &byte, 1) == -1);  // closed
}

TEST_CASE("another program's exit code, if it has one") {
  CHECK(run_program("/bin/sh", {"sh", "-c", "exit 7"}).code == 7);
  CHECK(run_program("/bin/sh", {"sh", "-c", "cat"}).code == 0);  // its input is empty
  CHECK(run_program("/bin/sh", {"sh", "-c", "kill -9 $$"}).code == std::nullopt);
  CHECK(run_program("/no/such/program", {"program"}).code.value_or(127) == 127);
}

}  // namespace tyglab::child_test
