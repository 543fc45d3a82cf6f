// The timeline: every step of what was recorded is reached to the last bit, forwards and back, and nothing is lost
// where the motion takes another course.
#include "app/session/timeline.h"

#include <doctest/doctest.h>

#include <map>
#include <string>

#include "app/session/motion.h"
#include "app/session/session.h"
#include "core/integrators/scheme.h"
#include "core/io/preset_io.h"
#include "tests/support/sanitized.h"
#include "tests/support/scenes.h"

namespace tyglab::timeline_test {

struct Played {
  explicit Played(const Preset& preset) {
    session.simulation = std::make_shared<Simulation>(preset);
    session.document.saved = preset;
    session.pacing.patient = session.scripted = true;
  }
  Simulation& cloth() { return *session.simulation; }
  std::int64_t step() { return cloth().past().steps(); }
  /// Makes frames, and notes the positions after each.
  void play(int frames, std::optional<glm::dvec3> hand = {}) {
    session.pacing.playing = true;
    SessionInput input;
    input.hand = hand;
    seen[step()] = cloth().hash();
    for (int n = 0; n < frames; ++n) session.update(1.0 / 60, input), seen[step()] = cloth().hash();
  }
  void change(double k_s) {
    Preset next = session.preset();
    next.k_s = k_s;
    REQUIRE(apply_edit(session, edit::Change{next}));
  }
  bool said(const std::string& part) const {
    for (const Message& message : session.messages.list())
      if (message.text.find(part) != std::string::npos) return true;
    return false;
  }

  Session session;
  std::map<std::int64_t, std::uint64_t> seen;  ///< hash by step
};

/// Something happens between frames.
void happen(Played& played, test::Random& random) {
  const int i = random.below(8), j = random.below(8);
  switch (random.below(8)) {
    case 0:
      played.change(random.uniform(20, 50));
      break;
    case 1:
      apply_edit(played.session, edit::Cut{{{i, j}}});
      break;
    case 2:
      apply_edit(played.session, edit::Pin{i, j, random.below(2) == 0});
      break;
    case 3: {
      if (!apply_edit(played.session, edit::Grab{i, j})) break;
      played.play(6, played.cloth().position(i, j) + glm::dvec3(0.05, 0.02, random.uniform(-0.1, 0.1)));
      apply_edit(played.session, edit::Release{});
      break;
    }
    case 4:
      apply_edit(played.session, edit::MoveBody{0, {random.uniform(-0.1, 0.1), 0.5, 0}, 9});
      break;
    case 5:
      restart(played.session);
      break;
    default:
      break;
  }
}

TEST_CASE("every step is reached to the last bit, back and forth, with every method" * doctest::test_suite("slow")) {
  int walks = 0;
  for (const Scheme& method : schemes())
    for (const Precision precision : {Precision::float_, Precision::double_}) {
      Preset preset = test::cloth(8, 8, std::string(method.name));
      preset.precision = precision, preset.dt = 1e-3, preset.k_s = 30;
      preset.bodies = {Body{.c = {0.1, 0.5, 0}, .r = 0.1}};
      if (method.name == "euler" || method.name == "improved_euler") preset.dt = 2e-4;
      CAPTURE(std::string(method.name));
      CAPTURE(int(precision));
      test::Random random(std::uint64_t(++walks));
      Played played(preset);
      for (int n = 0; n < test::fewer(16, 6); ++n) happen(played, random), played.play(4);
      if (played.cloth().divergence()) continue;
      const std::int64_t end = played.step();
      const std::uint64_t at_end = played.cloth().hash();
      const auto seen = played.seen;
      REQUIRE(seen.size() > 8);
      for (int n = 0; n < test::fewer(30, 6); ++n) {
        const auto to = std::next(seen.begin(), random.below(int(seen.size())));
        go_to_step(played.session, to->first);
        REQUIRE(played.step() == to->first);
        CHECK(played.cloth().hash() == to->second);
      }
      CHECK(present_line(played.session).steps() == end);
      while (played.session.repetition && played.step() < end) played.play(1);
      go_to_step(played.session, end);
      CHECK(played.cloth().hash() == at_end);
    }
  CHECK(walks > 20);
}

TEST_CASE("back at an earlier step the motion repeats what was done, then goes on") {
  Played played(test::cloth(8, 8));
  played.play(10), played.change(30), played.play(10);
  const std::int64_t end = played.step();
  const std::uint64_t at_end = played.cloth().hash();
  go_to_step(played.session, 20);
  CHECK(played.step() == 20);
  CHECK(played.session.preset().k_s == 50);
  REQUIRE(played.session.repetition);
  while (played.step() < end) played.play(1);
  CHECK(played.session.preset().k_s == 30);
  CHECK(!played.session.repetition);
  CHECK(played.session.pacing.playing);
  go_to_step(played.session, end);
  CHECK(played.cloth().hash() == at_end);
}

TEST_CASE("a change on the way begins another course, and the former one can be returned to") {
  Played played(test::cloth(8, 8));
  played.play(30);
  const std::int64_t end = played.step();
  const std::uint64_t at_end = played.cloth().hash();
  go_to_step(played.session, 100);
  played.change(20);
  CHECK(!played.session.repetition);
  CHECK(played.said("takes another course"));
  REQUIRE(played.session.timeline.branches().size() == 1);
  CHECK(played.session.timeline.branches()[0].from == 100);
  played.play(20);
  const std::int64_t other_end = played.step();
  const std::uint64_t at_other_end = played.cloth().hash();
  CHECK(present_line(played.session).steps() == other_end);

  go_to_branch(played.session, 0);
  CHECK(played.step() == 100);
  CHECK(played.session.preset().k_s == 50);
  go_to_step(played.session, end);
  CHECK(played.cloth().hash() == at_end);

  REQUIRE(played.session.timeline.branches().size() == 1);
  go_to_branch(played.session, 0);
  go_to_step(played.session, other_end);
  CHECK(played.session.preset().k_s == 20);
  CHECK(played.cloth().hash() == at_other_end);
}

TEST_CASE("branches of branches lead to the cloth that was left there, wherever the motion has gone since") {
  Played played(test::cloth(8, 8));
  played.play(150);
  const std::int64_t end = played.step();
  const std::uint64_t at_end = played.cloth().hash();
  const auto seen = played.seen;
  go_to_step(played.session, 1500), played.change(20), played.play(80);
  go_to_step(played.session, 400), played.change(40), played.play(120);
  REQUIRE(played.session.timeline.branches().size() == 2);
  go_to_branch(played.session, 0);
  CHECK(played.step() == 400);
  CHECK(played.session.preset().k_s == 50);
  go_to_step(played.session, 1600);
  CHECK(played.cloth().hash() == seen.at(1600));
  go_to_step(played.session, end);
  CHECK(played.cloth().hash() == at_end);
}

TEST_CASE("other views, saving and checks on the way change nothing of what is repeated") {
  Played played(test::cloth(8, 8));
  played.play(10), played.change(30), played.play(40);
  apply_edit(played.session, edit::Cut{{{4, 4}}}), played.play(40);
  const auto seen = played.seen;
  go_to_step(played.session, 20);
  for (int mode = 2; mode < 5; ++mode) {
    Preset next = played.session.preset();
    next.mode = mode;
    REQUIRE(apply_edit(played.session, edit::Change{next}));
    REQUIRE(played.session.repetition);
    played.play(10);
  }
  for (const auto& [step, hash] : seen) {
    go_to_step(played.session, step);
    REQUIRE(played.step() == step);
    CHECK(played.cloth().hash() == hash);
    CHECK(played.session.preset().mode == 4);
  }
}

TEST_CASE("what was undone at the very step of a kept moment does not come back") {
  Played played(test::cloth(8, 8));
  REQUIRE(apply_edit(played.session, edit::Cut{{{4, 4}}}));
  played.play(5);
  take_from_history(played.session, true);
  CHECK(played.cloth().tears().untorn());
  played.play(20);
  for (const std::int64_t step : {33, 0, 100}) {
    go_to_step(played.session, step);
    CHECK(played.cloth().tears().untorn());
  }
}

TEST_CASE("changes are unsaved wherever one is on the timeline; what changes nothing leaves no line") {
  Played played(test::cloth(8, 8));
  played.play(10), played.change(30), played.play(10);
  go_to_step(played.session, played.step() - 5);
  REQUIRE(played.session.repetition);
  CHECK(unsaved(played.session));
  apply_edit(played.session, edit::Cut{{{100, 100}}});
  CHECK(played.session.repetition);
  take_from_history(played.session, true);
  CHECK(played.said("nothing to undo"));
  CHECK(played.session.repetition);
}

TEST_CASE("a step that takes too long to compute is approached as far as time allows") {
  Played played(test::cloth(8, 8));
  played.session.timeline.clear();
  played.play(30);
  Session& session = played.session;
  go_to_step(session, 400, 0);
  CHECK(played.step() <= 400);
  CHECK(session.repetition);
  go_to_step(session, 400);
  CHECK(played.step() == 400);
}

TEST_CASE("rewinding and undoing leave a branch behind") {
  Played played(test::cloth(8, 8));
  played.play(150);
  const std::int64_t end = played.step();
  REQUIRE(rewind(played.session));
  CHECK(played.step() < end);
  REQUIRE(played.session.timeline.branches().size() == 1);
  go_to_branch(played.session, 0), go_to_step(played.session, end);
  CHECK(played.step() == end);
}

TEST_CASE("the way across a divergence, a restart and another lattice") {
  Preset preset = test::cloth(8, 8);
  preset.k_s = 1e5, preset.dt = 1e-3;
  Played played(preset);
  played.play(20);
  REQUIRE(played.cloth().divergence());
  const std::int64_t diverged = played.step();
  played.change(30), restart(played.session), played.play(10);
  Preset next = played.session.preset();
  next.rows = 5;
  REQUIRE(apply_edit(played.session, edit::Change{next}));
  played.play(10);
  const std::int64_t end = played.step();
  const std::uint64_t at_end = played.cloth().hash();
  const auto later = *played.seen.lower_bound(diverged + 20);
  go_to_step(played.session, later.first);
  CHECK(played.cloth().lattice().rows == 8);
  CHECK(played.cloth().hash() == later.second);
  go_to_step(played.session, end);
  CHECK(played.cloth().lattice().rows == 5);
  CHECK(played.cloth().hash() == at_end);
  go_to_step(played.session, 0);
  CHECK(played.step() == 0);
  CHECK(played.session.preset().k_s == 1e5);
}

TEST_CASE("memory stays within its limit, however long the motion is") {
  Preset preset = test::cloth(40, 40);
  preset.dt = 0.2;
  preset.g = 0, preset.k_s = preset.k_b = preset.k_d = 0;
  Simulation simulation(preset);
  Timeline timeline;
  for (int n = 0; n < test::fewer(3000, 300); ++n) timeline.look(simulation), simulation.advance(3);
  CHECK(timeline.bytes() <= Timeline::most_bytes);
  // Recent moments are near a snapshot, and old ones are not far from one, or from the start.
  const std::int64_t end = simulation.past().steps();
  const auto from = [&](std::int64_t step) {
    const Snapshot* snapshot = timeline.before(simulation.past(), step);
    return snapshot != nullptr ? snapshot->past.steps() : 0;
  };
  CHECK(end - from(end) <= 6);
  for (std::int64_t step = 10; step < end; step += end / 20) CHECK(step - from(step) <= end / 10);
}

TEST_CASE("marks say what was done; a stroke is one") {
  Played played(test::cloth(8, 8));
  played.play(3), played.change(30), played.play(3);
  for (int n = 0; n < 5; ++n) apply_edit(played.session, edit::Cut{{{3, n + 1}}}), played.play(1);
  played.play(60);
  apply_edit(played.session, edit::Pin{7, 7, true}), played.play(1);
  const auto& marks = played.session.timeline.marks(present_line(played.session), 1e9);
  REQUIRE(marks.size() == 3);
  CHECK(marks[0].words == "k_s=30");
  CHECK(marks[1].kind == TimelineMark::Kind::cut);
  CHECK(marks[2].words == "pinned (7, 7)");
}

TEST_CASE("steps, tenths and ends of the way") {
  Played played(test::cloth(8, 8));
  played.play(20);
  const std::int64_t end = played.step();
  go_by(played.session, 0, -1);
  CHECK(played.step() == end - 1);
  CHECK(!played.session.pacing.playing);
  go_by(played.session, -0.1, 0);
  CHECK(played.step() == end - 101);
  go_by(played.session, 0.1, 0), go_by(played.session, 0, 1);
  CHECK(played.step() == end);
  go_by(played.session, 0, 1);
  CHECK(played.step() == end);
  CHECK(played.said("Nothing is recorded beyond"));
  go_by(played.session, -100, 0);
  CHECK(played.step() == 0);
}

}  // namespace tyglab::timeline_test
