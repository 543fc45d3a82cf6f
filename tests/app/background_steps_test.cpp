// Steps that take longer than a frame: the session goes on beside them, and whoever changes the cloth stops them.
#include "app/session/background_steps.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "app/session/motion.h"
#include "app/session/session.h"
#include "tests/app/desk.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::background_steps_test {
namespace {

constexpr double frame = 1 / 60.0;

/// Stiff cloth whose step takes many times as long as a frame may: the default where it is stopped, 96 particles a side
/// where a test waits for it.
Preset long_steps(int side = 256) {
  if (test::sanitized) side /= 3;  // which makes steps long enough
  Preset preset = test::cloth(side, side, "implicit_euler");
  preset.k_s = 1e5, preset.dt = 1 / 60.0, preset.iterations = 50;
  return preset;
}

bool same(const State& a, const State& b) {
  return std::equal(a.x.x.begin(), a.x.x.end(), b.x.x.begin()) &&
         std::equal(a.x.y.begin(), a.x.y.end(), b.x.y.begin()) && std::equal(a.v.y.begin(), a.v.y.end(), b.v.y.begin());
}

/// A session in the middle of its first step.
struct Under {
  explicit Under(const Preset& preset = long_steps()) : desk(preset) {
    desk.session.update(frame, {});
    desk.session.update(frame, {});
    REQUIRE(desk.session.background_steps.busy());
  }
  test::Desk desk;
};

}  // namespace

TEST_CASE("while a step is being made, the session shows the cloth before it, and goes on") {
  Under under(long_steps(96));
  Session& session = under.desk.session;
  const State start = Simulation(session.preset()).read();
  int updates = 0;
  while (session.background_steps.busy()) {
    CHECK_FALSE(session.idle());
    CHECK(session.simulation->steps() == 0);
    CHECK(same(session.simulation->read(), start));
    const double part = session.background_steps.progress();
    CHECK((part >= 0 && part <= 1));
    session.update(frame, {});
    ++updates;
  }
  CHECK(updates > 0);
  session.pacing.playing = false;
  const std::int64_t steps = session.simulation->steps();
  REQUIRE(steps >= 1);
  Simulation alone(session.preset());
  alone.advance(int(steps));
  CHECK(same(session.simulation->read(), alone.read()));
}

TEST_CASE("dt that becomes automatic while a step is being made is watched once the ledger is kept") {
  Preset preset = long_steps(96);
  preset.dt = AutoStep::longest;
  Under under(preset);
  Session& session = under.desk.session;
  toggle_auto_dt(session);
  REQUIRE(session.auto_dt.has_value());
  REQUIRE(session.background_steps.busy());
  while (session.background_steps.busy()) session.update(frame, {});
  CHECK(session.simulation->steps() >= 1);
  CHECK(session.preset().dt == AutoStep::longest);
  session.update(frame, {});
  CHECK((session.background_steps.busy() || session.simulation->ledger().has_value()));
}

TEST_CASE("a step whose equations were not solved is said once, with what is left") {
  Preset preset = long_steps(24);
  preset.iterations = 1;
  test::Desk desk(preset);
  Session& session = desk.session;
  session.pacing.patient = true;
  const auto warnings = [&] {
    const auto& said = session.messages.list();
    return std::count_if(said.begin(), said.end(), [](const Message& message) {
      return message.severity == Message::Severity::warning &&
             message.text.find("stopped early (up to ") != message.text.npos;
    });
  };
  while (session.simulation->steps() < 4) session.update(frame, {});
  CHECK(session.simulation->engine().solves().unconverged > 1);
  CHECK(warnings() == 1);
}

TEST_CASE("a precision that is too coarse is said before the first step, and again only after it was fine") {
  Preset preset;
  preset.integrator = "verlet", preset.k_s = 1e7, preset.F_max = 0.5, preset.dt = 1e-6;
  test::Desk desk(preset);
  Session& session = desk.session;
  const auto warnings = [&] {
    const auto& said = session.messages.list();
    return std::count_if(said.begin(), said.end(), [](const Message& message) {
      return message.severity == Message::Severity::warning && message.text.starts_with("Rounding positions to float");
    });
  };
  session.pacing.playing = true;
  session.update(0, {});
  CHECK(session.simulation->steps() == 0);
  CHECK(warnings() == 1);
  session.messages = {};
  for (int n = 0; n < 3; ++n) session.update(frame, {});
  CHECK(warnings() == 0);
  preset.precision = Precision::double_;
  session.propose(preset);
  for (int n = 0; n < 3; ++n) session.update(frame, {});
  CHECK(warnings() == 0);
  preset.precision = Precision::float_;
  session.propose(preset);
  for (int n = 0; n < 3; ++n) session.update(frame, {});
  CHECK(warnings() == 1);
}

TEST_CASE("a change of constants stops the step at once, and counts from the last whole one") {
  Under under;
  Session& session = under.desk.session;
  Preset softer = session.preset();
  softer.k_s = 50, softer.iterations = 5;
  session.propose(softer);
  session.update(0, {});
  CHECK(session.preset().k_s == 50);
  CHECK(session.simulation->steps() == 0);
  CHECK(session.simulation->time() == 0);
}

TEST_CASE("what is only seen is changed without stopping the step, and stays when the step is there") {
  Under under;
  Session& session = under.desk.session;
  Preset other = session.preset();
  other.mode = other.mode == 1 ? 2 : 1;
  session.propose(other);
  session.update(0, {});
  CHECK(session.background_steps.busy());
  CHECK(session.preset().mode == other.mode);
  settle(session);
  CHECK_FALSE(session.background_steps.busy());
  CHECK(session.preset().mode == other.mode);
}

TEST_CASE("the hand, the knife, pins, restart and rewind stop the step") {
  const auto check = [](const auto& act) {
    Under under;
    act(under.desk.session);
    CHECK_FALSE(under.desk.session.background_steps.busy());
    CHECK(under.desk.session.simulation->steps() == 0);
  };
  check([](Session& session) {
    CHECK(apply_edit(session, edit::Grab{10, 10}));
    CHECK(session.simulation->held().has_value());
  });
  check([](Session& session) {
    CHECK(apply_edit(session, edit::Cut{{{10, 10}}}));
    CHECK(session.simulation->tears().torn_count() > 0);
  });
  check([](Session& session) {
    CHECK(apply_edit(session, edit::Pin{20, 20, true}));
    CHECK(session.simulation->pinned(20, 20));
  });
  check([](Session& session) { restart(session); });
}

TEST_CASE("a pause lets the step end, a single step is made beside the frames too") {
  Under under(long_steps(96));
  Session& session = under.desk.session;
  session.pacing.playing = false;
  while (session.background_steps.busy()) session.update(frame, {});
  CHECK(session.simulation->steps() == 1);
  session.update(frame, {});
  CHECK(session.simulation->steps() == 1);
  single_step(session, std::nullopt);
  while (session.background_steps.busy()) session.update(frame, {});
  CHECK(session.simulation->steps() == 2);
}

TEST_CASE("copies whose steps take long are made beside the frames with the cloth's own") {
  Preset preset = long_steps(96);
  preset.integrator = "verlet", preset.dt = 1e-5;
  test::Desk desk(preset);
  Session& session = desk.session;
  add_copy(session, {{&Preset::integrator, "implicit_euler"}, {&Preset::dt, 1 / 60.0}}, false);
  REQUIRE(session.copies.lockstep.size() == 1);
  bool beside = false;
  for (int n = 0; n < 10'000 && session.copies.lockstep[0].simulation->steps() == 0; ++n) {
    session.update(frame, {});
    beside = beside || session.background_steps.busy();
  }
  settle(session);
  CHECK(beside);
  CHECK(session.copies.lockstep[0].simulation->steps() >= 1);
  remove_copy(session, 0);
  CHECK(session.copies.lockstep.empty());
}

TEST_CASE("a session that ends in the middle of a step, or gets another cloth then, waits for nobody") {
  { const Under ends; }
  Under under;
  Session& session = under.desk.session;
  Preset smaller = long_steps(8);
  smaller.iterations = 2;
  session.propose(smaller);
  session.update(0, {});
  CHECK(session.simulation->lattice().rows == smaller.rows);
}

}  // namespace tyglab::background_steps_test
