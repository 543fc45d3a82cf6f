// The last steps before a divergence once more, slowly.
#include "app/session/replay.h"

#include <doctest/doctest.h>

#include <cstdlib>

#include "app/session/motion.h"
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
  CHECK(std::abs(double(session.simulation->divergence()->step - then.step)) <= 10);
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
