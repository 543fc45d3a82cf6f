// The guard finds the very step that goes wrong, tears or lets go, however many steps are made between examinations.
#include "core/engines/step_guard.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace tyglab::step_guard_test {

constexpr double too_long = 1000, overloaded = 400;
constexpr double no_limit = 1e300;

/// One spring whose length after n steps is given. Several steps are made at a time, of which only the last can be
/// seen.
class OneSpring final : public GuardedSteps {
 public:
  explicit OneSpring(std::function<double(int)> length) : length_(std::move(length)) {}

  AdvanceResult advance(int steps) { return guard.advance(*this, steps, tears, {}); }

  BatchResult make_steps(int most, Tears& torn, Fault& fault) override {
    const int count = std::min(guard.steps_ahead(most), at_once);
    first_ = made, made += count;
    const BatchResult result = guard.judge(*this, count, torn, fault);
    rolled_back += result.end == BatchEnd::rolled_back ? 1 : 0;
    return result;
  }
  StepMeasures measures(int step) override {
    StepMeasures result;
    result.elongation = length_(first_ + step + 1) - length_(first_ + step), result.dt = dt;
    if (hand) result.hand_force = glm::dvec3(0, length_(first_ + step + 1), 0);
    return result;
  }
  double tear_overloaded(Tears& torn) override {
    ++examined;
    if (length_(made) <= overloaded || torn.torn_count() > 0)
      return torn.torn_count() > 0 ? no_limit : overloaded - length_(made);
    torn_at = made;
    torn.tear(0, 0, 0);
    return no_limit;
  }
  bool find_fault(Tears& torn, Fault& fault, double& budget) override {
    ++examined;
    budget = torn.torn_count() > 0 && std::isfinite(length_(made)) ? no_limit : too_long - length_(made);
    fault = {0, 0, "spring length", length_(made), 0, 1};
    return !(budget >= 0);
  }
  bool find_runaway(const MotionLimit& limit, Fault& fault) override {
    ++summed;
    const double speed = (length_(made) - length_(made - 1)) / (2 * dt);
    fault = {0, 0, "velocity", speed};
    return speed * speed > limit.most_squared();
  }
  Motion motion(const Tears&) override { return ++measured, Motion{}; }
  void keep_backup() override { backup_ = made, torn_at_backup_ = tears.torn_count(), ++backups; }
  /// As an engine would: every step is examined, and what is overloaded breaks.
  void repeat(int steps, Tears& torn) override {
    CHECK(torn.torn_count() == torn_at_backup_);
    for (made = backup_; made < backup_ + steps;) {
      ++made;
      if (tearing) tear_overloaded(torn);
    }
    first_ = made - 1;
  }

  StepGuard guard;
  Tears tears{Lattice{2, 2}};
  int at_once = 1, made = 0, examined = 0, summed = 0, measured = 0, backups = 0, rolled_back = 0, torn_at = 0;
  double dt = 1;
  bool hand = false, tearing = false;

 private:
  std::function<double(int)> length_;
  int first_ = 0, backup_ = 0, torn_at_backup_ = 0;
};

/// Grows slowly, then suddenly, so that batches overshoot.
double sudden(int n) {
  return n <= 700 ? 0.1 * n : 70 + 30.0 * (n - 700) * (n - 700);
}
int last_under(double limit) {
  int n = 0;
  while (sudden(n + 1) <= limit) ++n;
  return n;
}

TEST_CASE("a run stops before the first bad step, with few examinations") {
  for (const int at_once : {1, 2, 7, 256})
    for (const int calls : {1, 3, 1000}) {
      CAPTURE(at_once);
      CAPTURE(calls);
      OneSpring spring(sudden);
      spring.at_once = at_once;
      int steps = 0;
      AdvanceResult last;
      for (int n = 0; n < 2000 && !last.diverged; n += std::max(1, 2000 / calls))
        last = spring.advance(std::max(1, 2000 / calls)), steps += last.steps;
      CHECK(last.diverged);
      CHECK(steps == last_under(too_long));
      CHECK(spring.made == steps);
      CHECK(last.value == sudden(steps + 1));
      CHECK(last.quantity == "spring length");
      CHECK(spring.examined < 40);
      CHECK((spring.rolled_back > 0) == (at_once > 2 && calls < 1000));
    }
}

TEST_CASE("a spring breaks in the step that overloads it, also in steps that are made again") {
  for (const int at_once : {1, 2, 7, 256}) {
    CAPTURE(at_once);
    OneSpring spring(sudden);
    spring.at_once = at_once, spring.tearing = true;
    spring.guard.set_rules({.tearing = true});
    const AdvanceResult all = spring.advance(2000);
    CHECK_FALSE(all.diverged);
    CHECK(all.steps == 2000);
    CHECK(all.torn == 1);
    CHECK(spring.torn_at == last_under(overloaded) + 1);
    CHECK(spring.tears.torn_count() == 1);
  }
}

TEST_CASE("steps that are made again begin with the springs that were whole then") {
  OneSpring spring([](int n) { return n <= 750 ? sudden(n) : std::numeric_limits<double>::quiet_NaN(); });
  spring.tearing = true;
  spring.guard.set_rules({.tearing = true});
  const AdvanceResult all = spring.advance(2000);
  CHECK(all.diverged);
  CHECK(all.steps == 750);
  CHECK(spring.torn_at == last_under(overloaded) + 1);
  CHECK(all.torn == 1);
}

TEST_CASE("the hand lets go after the step whose force exceeds F_release") {
  for (const int at_once : {1, 7, 256}) {
    CAPTURE(at_once);
    OneSpring spring(sudden);
    spring.at_once = at_once, spring.hand = true;
    spring.guard.set_rules({.F_release = 300});
    const AdvanceResult all = spring.advance(2000);
    CHECK(all.released);
    CHECK_FALSE(all.diverged);
    CHECK(all.steps == last_under(300) + 1);
    CHECK(spring.made == all.steps);
    CHECK(all.hand_force.y == sudden(all.steps));
  }
}

TEST_CASE("a length that is no number is found in the step that makes it") {
  OneSpring spring([](int n) { return n <= 300 ? 1.0 : std::numeric_limits<double>::quiet_NaN(); });
  spring.at_once = 256;
  const AdvanceResult all = spring.advance(2000);
  CHECK(all.diverged);
  CHECK(all.steps == 300);
  CHECK(spring.made == 300);
}

TEST_CASE("a motion that nothing can have caused ends the run in its step, and speeds are hardly ever summed up") {
  // It falls from rest, 2 g dt a step for the spring between two that fall apart, until a kick in step 701.
  constexpr int kick = 700;
  const auto falls = [](int n) { return 1e-3 * n * n + (n > kick ? 50.0 * (n - kick) : 0); };
  for (const int at_once : {1, 7, 256})
    for (const int calls : {1, 3, 1000}) {
      CAPTURE(at_once);
      CAPTURE(calls);
      OneSpring spring(falls);
      spring.at_once = at_once, spring.tears.tear(0, 0, 0);
      Preset preset;
      preset.dt = spring.dt, preset.g = 1e-3, preset.F_max = 1e-9, preset.k_b = 0;
      spring.guard.set_scene(preset, spring.tears.lattice(), {});
      spring.guard.begin({});
      int steps = 0;
      AdvanceResult last;
      for (int n = 0; n < 2000 && !last.diverged; n += std::max(1, 2000 / calls))
        last = spring.advance(std::max(1, 2000 / calls)), steps += last.steps;
      CHECK(last.diverged);
      CHECK(last.quantity == "velocity");
      CHECK(steps == kick);
      CHECK(spring.made == steps);
      CHECK(spring.summed < 4);
      CHECK(spring.measured == 0);
    }
}

TEST_CASE("what an edit may have given is measured before the next step, and wind alone is not") {
  OneSpring spring([](int) { return 1.0; });
  Preset preset;
  Preset next = preset;
  next.W = {0, 0, 0.01};
  spring.guard.accept_changes(preset, next), spring.advance(1);
  CHECK(spring.measured == 0);
  next.k_s = 100;
  spring.guard.accept_changes(preset, next), spring.advance(1), spring.advance(1);
  CHECK(spring.measured == 1);
  spring.guard.expect_pushes(), spring.advance(1), spring.advance(1);
  CHECK(spring.measured == 2);
}

TEST_CASE("the state is backed up every 256 steps, after cuts, and before every run of costly steps") {
  OneSpring spring([](int) { return 1.0; });
  spring.advance(256);
  CHECK(spring.backups == 1);
  spring.advance(512);
  CHECK(spring.backups == 3);
  spring.advance(10), spring.advance(10);
  CHECK(spring.backups == 4);
  spring.tears.tear(2, 0, 0);
  CHECK(spring.guard.springs_cut(spring.tears));
  spring.guard.accept_cuts(spring.tears);
  spring.advance(10);
  CHECK(spring.backups == 5);
  CHECK_FALSE(spring.guard.springs_cut(spring.tears));
  spring.guard.invalidate();
  spring.advance(10);
  CHECK(spring.backups == 6);
  spring.guard.set_rules({.costly_steps = true});
  spring.advance(10), spring.advance(10);
  CHECK(spring.backups >= 8);
}

}  // namespace tyglab::step_guard_test
