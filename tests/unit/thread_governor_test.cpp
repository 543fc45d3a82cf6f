// The policy by which threads are let go and taken back, on a machine and a clock that are made up.
#include "core/engines/cpu/thread_governor.h"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <map>

namespace tyglab::thread_governor_test {

constexpr double alone = 1e-6;  // s for a unit of work, on one thread
constexpr double gain = 0.55;   // of that time with twice as many threads on free processors

/// A machine whose time passes only as its threads work.
class Machine {
 public:
  /// Seconds that so many threads take for a unit of work at that time.
  using Cost = std::function<double(int threads, double now)>;
  Machine(int threads, Cost cost) : governor_(threads, threads), cost_(std::move(cost)) {}

  /// Works for so many seconds more; returns the work done.
  double run(double seconds) {
    double done = 0;
    seconds_with_.clear();
    for (const double end = now_ + seconds; now_ < end;) {
      const int threads = governor_.threads();
      const double work = std::max(1.0, std::floor(governor_.run_seconds() / cost_(threads, now_)));
      double spent = 0;
      for (int part = 0; part < 10; ++part) spent += work / 10 * cost_(threads, now_ + spent);
      now_ += spent, done += work, seconds_with_[threads] += spent;
      governor_.worked(work, spent);
    }
    return done;
  }
  /// Of the last run.
  double seconds_with(int threads) { return seconds_with_[threads]; }
  int threads() const { return governor_.threads(); }

 private:
  cpu::ThreadGovernor governor_;
  Cost cost_;
  double now_ = 0;
  std::map<int, double> seconds_with_;
};

double on_free_processors(int threads, double) {
  return threads == 1 ? alone : gain * alone;
}
double beside_load(int threads, double) {
  return threads == 1 ? alone : 2.8 * alone;
}

TEST_CASE("on free processors all threads work, and trials cost less than half a percent") {
  Machine machine(2, on_free_processors);
  machine.run(0.01);
  CHECK(machine.seconds_with(1) == 0.0);  // a short run is left alone
  CHECK(machine.run(1) > 0.98 * 1 / (gain * alone));
  CHECK(machine.run(10) > 0.995 * 10 / (gain * alone));
  CHECK(machine.seconds_with(1) > 0.0);
}

TEST_CASE("threads that lose time are let go, and tried again ever more seldom") {
  Machine machine(2, beside_load);
  machine.run(0.05);
  CHECK(machine.threads() == 1);
  const double first = machine.run(1), later = machine.run(10);
  CHECK(first > 0.96 / alone);
  CHECK(later > 0.995 * 10 / alone);
  CHECK(later < 10 / alone);
  CHECK(machine.seconds_with(2) > 0.0);
}

TEST_CASE("threads that gain less than a tenth are let go too") {
  Machine machine(2, [](int threads, double) { return threads == 1 ? alone : 0.95 * alone; });
  machine.run(1);
  machine.run(10);
  CHECK(machine.seconds_with(2) < 1.0);
}

TEST_CASE("a load that comes and goes is followed") {
  Machine machine(2, [](int threads, double now) {
    return (now > 5 && now < 10) || (now > 17 && now < 17.1) ? beside_load(threads, now)
                                                             : on_free_processors(threads, now);
  });
  machine.run(5);
  machine.run(0.1);
  CHECK(machine.threads() == 1);
  machine.run(4.9);
  CHECK(machine.seconds_with(1) > 4.8);
  machine.run(2);
  CHECK(machine.run(5) > 0.99 * 5 / (gain * alone));
  machine.run(0.1);
  CHECK(machine.seconds_with(1) > 0.07);
  CHECK(machine.run(1) > 0.9 * 1 / (gain * alone));  // the long rest is forgotten
}

TEST_CASE("a partner that loses its processor for every other slice costs nothing in the long run") {
  // For 3 ms both work, then one waits for the other for 5 ms: slower than one alone.
  Machine machine(2, [](int threads, double now) {
    if (threads == 1) return alone;
    return std::fmod(now, 0.008) < 0.003 ? gain * alone : 20 * alone;
  });
  machine.run(1);
  CHECK(machine.run(10) > 0.99 * 10 / alone);
}

TEST_CASE("a stall now and then is forgiven") {
  Machine machine(2, [](int threads, double now) {
    return threads == 2 && std::fmod(now, 0.1) > 0.096 ? 20 * alone : on_free_processors(threads, now);
  });
  machine.run(1);
  machine.run(10);
  CHECK(machine.seconds_with(1) < 0.5);
}

TEST_CASE("work that becomes longer for any number of threads changes little") {
  Machine machine(2, [](int threads, double now) { return (now > 2 ? 4 : 1) * on_free_processors(threads, now); });
  machine.run(2);
  CHECK(machine.run(2) > 0.98 * 2 / (4 * gain * alone));
}

TEST_CASE("of many threads half are let go at a time") {
  // Four processors, of which two are busy: the slowest thread decides.
  Machine busy(4, [](int threads, double) { return threads == 4 ? 2 * alone / 2 : alone / threads; });
  busy.run(1);
  CHECK(busy.run(10) > 0.98 * 10 / (alone / 2));
  CHECK(busy.seconds_with(2) > 9.5);

  Machine free(6, [](int threads, double) { return alone / threads; });
  CHECK(free.run(10) > 0.99 * 10 / (alone / 6));

  Machine useless(8, [](int threads, double) { return alone * threads; });
  useless.run(1);
  useless.run(10);
  CHECK(useless.seconds_with(1) > 9.8);
}

TEST_CASE("one thread has no choice") {
  Machine machine(1, beside_load);
  CHECK(machine.run(1) == doctest::Approx(1 / alone).epsilon(0.01));
  CHECK(machine.threads() == 1);
}

}  // namespace tyglab::thread_governor_test
