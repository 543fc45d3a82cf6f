// The last steps before a divergence once more, slowly.
#include "app/session/rewind.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "app/session/motion.h"
#include "app/session/requests.h"
#include "app/session/session.h"
#include "tests/support/scenes.h"

namespace tyglab::replay_test {

/// A cloth that explodes after some hundred steps.
Session exploding(double dt = 1.15e-3) {
  Session session;
  Preset preset = test::cloth(12, 12);
  preset.k_s = 200, preset.dt = dt;
  session.simulation = std::make_shared<Simulation>(preset);
  session.document.saved = preset;
  session.scripted = true;
  return session;
}

void run_until_diverged(Session& session) {
  session.pacing.patient = true;
  for (int n = 0; n < 3000 && !session.simulation->divergence(); ++n) session.update(0.05, {});
  REQUIRE(session.simulation->divergence());
}

TEST_CASE("a replay begins fifty steps before the divergence, slowly, and ends in it") {
  Session session = exploding();
  session.pacing.speed = 1;
  run_until_diverged(session);
  const Divergence then = *session.simulation->divergence();
  CHECK(nothing_to_replay(session).empty());
  session.request(request::Replay{});
  session.update(0, {});
  REQUIRE(session.replay);
  CHECK_FALSE(session.simulation->divergence());
  CHECK(session.simulation->steps() == then.step - 51);
  CHECK(session.pacing.playing);
  CHECK(session.pacing.speed == doctest::Approx(50 * session.preset().dt / Replay::lasts));
  run_until_diverged(session);
  CHECK(session.simulation->divergence()->step == then.step);
  CHECK(session.simulation->divergence()->value == then.value);  // the same motion, to the last bit
  CHECK_FALSE(session.replay);
  CHECK(session.pacing.speed == 1);
}

TEST_CASE("what diverges within fifty steps is replayed from its start") {
  Session session = exploding(0.02);
  run_until_diverged(session);
  REQUIRE(session.simulation->divergence()->step < 50);
  session.request(request::Replay{});
  session.update(0, {});
  REQUIRE(session.replay);
  CHECK(session.simulation->steps() == 0);
}

/// Goes on until it is that time, s.
void run_to(Session& session, double t) {
  session.pacing.patient = true;
  while (session.simulation->time() < t) session.update(0.01, {});
}

TEST_CASE("a replay begins no earlier than constants were changed last, so that the same explosion follows") {
  Session session = exploding(1e-3);
  Preset preset = session.preset();
  preset.k_s = 20;
  apply_edit(session, edit::Change{preset});
  run_to(session, 0.93);
  REQUIRE_FALSE(session.simulation->divergence());
  preset.k_s = 1000;
  apply_edit(session, edit::Change{preset});
  const std::int64_t changed_at = session.simulation->steps();
  run_until_diverged(session);
  const Divergence then = *session.simulation->divergence();
  REQUIRE(then.step - changed_at < 50);
  for (int times = 0; times < 2; ++times) {
    session.request(request::Replay{});
    session.update(0, {});
    REQUIRE(session.replay);
    CHECK(session.simulation->steps() == changed_at);
    run_until_diverged(session);
    CHECK(std::abs(double(session.simulation->divergence()->step - then.step)) <= 3);
  }
}

TEST_CASE("a replay sets constants that have changed since back to those that diverged, and that can be undone") {
  Session session = exploding();
  run_until_diverged(session);
  const Divergence then = *session.simulation->divergence();
  Preset later = session.preset();
  later.k_s = 1520;
  apply_edit(session, edit::Change{later});
  REQUIRE(changed_since_divergence(session));
  session.request(request::Replay{});
  session.update(0, {});
  REQUIRE(session.replay);
  CHECK(session.preset().k_s == 200);
  run_until_diverged(session);
  CHECK(std::abs(double(session.simulation->divergence()->step - then.step)) <= 10);
  take_from_history(session, true);
  CHECK(session.preset().k_s == 1520);
}

TEST_CASE("a replay sets the method back, too") {
  Session session = exploding();
  run_until_diverged(session);
  const Divergence then = *session.simulation->divergence();
  Preset later = session.preset();
  later.integrator = "implicit_euler";
  apply_edit(session, edit::Change{later});
  session.request(request::Replay{});
  session.update(0, {});
  REQUIRE(session.replay);
  CHECK(session.preset().integrator == "verlet");
  run_until_diverged(session);
  CHECK(std::abs(double(session.simulation->divergence()->step - then.step)) <= 10);
}

TEST_CASE("a restart leaves the replay, and there is none of a cloth that is well") {
  Session session = exploding();
  CHECK_FALSE(nothing_to_replay(session).empty());
  run_until_diverged(session);
  session.request(request::Replay{});
  for (int n = 0; n < 20; ++n) session.update(0.05, {});
  REQUIRE(session.replay);
  restart(session);
  session.update(0, {});
  CHECK_FALSE(session.replay);
  CHECK(session.pacing.speed == 1);
}

}  // namespace tyglab::replay_test
