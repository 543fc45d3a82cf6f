// Large cloths are built beside the frames: the present one goes on, and what is asked for meanwhile is not lost.
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <thread>

#include "app/session/document.h"
#include "app/session/session.h"
#include "core/model/effect.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::building_test {

constexpr int large = 400;  // rows and columns: above what is built within a frame

Session session_with(const Preset& preset) {
  Session session;
  session.simulation = std::make_shared<Simulation>(preset);
  session.document.saved = preset;
  return session;
}

Preset changed(Preset preset, int rows) {
  preset.rows = rows;
  return preset;
}

/// Frames pass until nothing is in work.
void wait(Session& session) {
  for (int n = 0; n < 20000 && session.rebuild.busy(); ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    session.rebuild.poll(session);
  }
  REQUIRE_FALSE(session.rebuild.busy());
}

TEST_CASE("a small cloth is changed at once, a large one beside the frames") {
  Session session = session_with(test::cloth(20, large));
  CHECK(apply_edit(session, edit::Change{changed(session.preset(), 30)}));
  CHECK_FALSE(session.rebuild.busy());
  CHECK(session.preset().rows == 30);
  session.simulation->advance(3);
  CHECK(apply_edit(session, edit::Change{changed(session.preset(), large)}));
  CHECK(session.rebuild.busy());
  CHECK_FALSE(session.rebuild.holds_present());
  CHECK(session.preset().rows == 30);
  CHECK(session.requested_preset().rows == large);
  CHECK(session.rebuild.lattice() == Lattice{large, large});
  session.simulation->advance(1);  // the present one goes on
  CHECK(session.simulation->steps() == 4);
  wait(session);
  CHECK(session.preset().rows == large);
  CHECK(session.simulation->steps() == 0);
  CHECK(session.history.next(true)->constants.rows == 30);
}

TEST_CASE("what is changed meanwhile is felt at once and by the cloth in work") {
  Session session = session_with(test::cloth(20, large));
  session.simulation->advance(3);
  apply_edit(session, edit::Change{changed(session.preset(), large)});
  Preset stiff = session.requested_preset();
  stiff.k_s = 77;
  apply_edit(session, edit::Change{stiff});
  CHECK(session.preset().k_s == 77);
  CHECK(session.preset().rows == 20);
  CHECK(session.requested_preset() == stiff);
  wait(session);
  CHECK(session.preset() == stiff);
  CHECK(session.history.take(true, {}).constants.rows == large);
  CHECK(session.history.next(true)->constants.rows == 20);
}

TEST_CASE("a newer wish replaces one in work, and going back to the present cloth drops it") {
  Session session = session_with(test::cloth(20, large));
  const Preset small = session.preset();
  apply_edit(session, edit::Change{changed(small, large)});
  apply_edit(session, edit::Change{changed(small, large + 10)});
  wait(session);
  CHECK(session.preset().rows == large + 10);
  session.simulation = std::make_shared<Simulation>(small);
  apply_edit(session, edit::Change{changed(small, large)});
  apply_edit(session, edit::Change{small});
  CHECK(session.requested_preset() == small);
  wait(session);
  CHECK(session.preset() == small);
}

TEST_CASE("a switch of precision keeps state and time, and lets no edit be lost") {
  Preset quick = test::cloth(large, large);
  quick.precision = Precision::float_;
  Session session = session_with(quick);
  session.simulation->advance(5);
  apply_edit(session, edit::Cut{{{200, 200}}});
  const glm::dvec3 x = session.simulation->positions().at(300, 300);
  Preset exact = quick;
  exact.precision = Precision::double_;
  apply_edit(session, edit::Change{exact});
  CHECK(session.rebuild.holds_present());
  CHECK(apply_edit(session, edit::Cut{{{100, 100}}}));
  CHECK_FALSE(apply_edit(session, edit::Grab{300, 300}));
  CHECK(session.simulation->tears().torn_count() == 3);
  wait(session);
  CHECK(session.preset().precision == Precision::double_);
  CHECK(session.simulation->steps() == 5);
  CHECK(session.simulation->tears().torn_count() == 6);
  CHECK(glm::length(session.simulation->positions().at(300, 300) - x) == 0);
}

TEST_CASE("a restart is built beside the frames too, and an engine that is not there leaves everything as it was") {
  Session session = session_with(test::cloth(large, large));
  session.simulation->advance(4);
  apply_edit(session, edit::Restart{});
  CHECK(session.simulation->steps() == 4);
  wait(session);
  CHECK(session.simulation->steps() == 0);
  const Preset before = session.preset();
  Preset other = before;
  other.engine = EngineKind::opencl, other.device = 99;
  apply_edit(session, edit::Change{other});
  wait(session);
  CHECK(session.preset() == before);
  CHECK(session.history.next(true)->what == "restart");
  CHECK(session.messages.list().size() == 1);
}

/// A cloth on an OpenCL device whose compiler waits until it may go on.
struct SlowCompiler {
  explicit SlowCompiler(const Preset& preset) : session(session_with(preset)) {
    session.rebuild.prepare_programs = [this](const Preset&, bool) {
      ++builds;
      while (!may_go_on) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    session.simulation->advance(3);
  }
  void change(double Preset::*constant, double to) {
    Preset next = session.requested_preset();
    next.*constant = to;
    apply_edit(session, edit::Change{next});
  }
  std::atomic<bool> may_go_on = false;
  std::atomic<int> builds = 0;
  Session session;
};

TEST_CASE("the ledger is kept once the program that notes contacts has been built beside the frames") {
  if (test::skipped_without_device()) return;
  Preset preset = test::cloth(20, 20);
  preset.engine = EngineKind::opencl;
  preset.bodies = {Body{}};
  SlowCompiler slow(preset);
  Session& session = slow.session;
  CHECK_FALSE(session.rebuild.ledger_ready(session));
  CHECK_FALSE(session.rebuild.ledger_ready(session));  // it is not ordered twice
  session.simulation->advance(2);
  slow.may_go_on = true;
  while (!session.rebuild.ledger_ready(session)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(slow.builds == 1);
  session.simulation->enable_ledger(true);
  session.simulation->advance(1);
  session.simulation->enable_ledger(false);
  CHECK(session.rebuild.ledger_ready(session));  // the program is there now
  CHECK(slow.builds == 1);
  Preset bare = test::cloth(20, 20);
  bare.engine = EngineKind::opencl;
  SlowCompiler other(bare);  // without bodies no other program is needed
  CHECK(other.session.rebuild.ledger_ready(other.session));
}

TEST_CASE("a feature that a device builds a program for is switched on beside the frames") {
  if (test::skipped_without_device()) return;
  Preset without = test::cloth(20, 20);
  without.engine = EngineKind::opencl;
  without.k_b = 0, without.k_d = 0;
  SlowCompiler slow(without);
  Session& session = slow.session;
  slow.change(&Preset::k_b, 1);
  CHECK(session.rebuild.programs());
  CHECK_FALSE(session.rebuild.holds_present());
  CHECK(session.preset().k_b == 0);
  CHECK(session.requested_preset().k_b == 1);
  session.simulation->advance(2);  // the old program goes on
  slow.change(&Preset::k_s, 77);
  slow.change(&Preset::k_b, 2);
  CHECK(session.preset().k_s == 77);  // which needs no program
  CHECK(session.preset().k_b == 0);
  slow.may_go_on = true;
  wait(session);
  CHECK(session.preset().k_b == 2);
  CHECK(session.preset().k_s == 77);
  CHECK(slow.builds == 1);
  CHECK(session.simulation->steps() == 5);
  session.simulation->advance(1);
  for (const double k_b : {0.0, 3.0}) {  // both programs are there now
    slow.change(&Preset::k_b, k_b);
    CHECK_FALSE(session.rebuild.busy());
    CHECK(session.preset().k_b == k_b);
  }
}

TEST_CASE("a copy on a device comes when its programs have been built beside the frames") {
  if (test::skipped_without_device()) return;
  SlowCompiler slow(test::cloth(20, 20));
  Session& session = slow.session;
  const std::vector<Difference> on_device{{&Preset::engine, EngineKind::opencl}};
  add_copy(session, on_device, false);
  CHECK(session.copies.lockstep.empty());
  session.pacing.playing = false;
  CHECK_FALSE(session.idle());
  poll_copies(session);
  add_copy(session, on_device, false);  // it is not ordered twice
  CHECK(session.copies.lockstep.empty());
  slow.may_go_on = true;
  while (session.copies.awaited) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    poll_copies(session);
  }
  CHECK(session.copies.lockstep.size() == 1);
  CHECK(slow.builds == 1);
}

TEST_CASE("a change for which a copy's device needs other programs is made once they are there") {
  if (test::skipped_without_device()) return;
  Preset without = test::cloth(20, 20);
  without.k_b = 0, without.k_d = 0;
  SlowCompiler slow(without);
  Session& session = slow.session;
  slow.may_go_on = true;
  add_copy(session, {{&Preset::engine, EngineKind::opencl}}, false);
  while (session.copies.awaited) poll_copies(session);
  REQUIRE(session.copies.lockstep.size() == 1);
  slow.may_go_on = false;
  slow.change(&Preset::k_b, 1);
  CHECK(session.rebuild.programs());
  CHECK(session.preset().k_b == 0);
  slow.may_go_on = true;
  wait(session);
  CHECK(session.preset().k_b == 1);
  CHECK(cloth_of(session, 0).preset().k_b == 1);
}

TEST_CASE("who takes the feature back meanwhile waits for nothing, and two features come one after the other") {
  if (test::skipped_without_device()) return;
  Preset without = test::cloth(20, 20, "velocity_verlet");
  without.engine = EngineKind::opencl;
  without.k_b = 0, without.k_d = 0;
  SlowCompiler slow(without);
  Session& session = slow.session;
  slow.change(&Preset::k_b, 1);
  slow.change(&Preset::k_b, 0);
  CHECK(session.rebuild.requested_preset() == nullptr);
  CHECK(session.preset() == without);
  slow.change(&Preset::k_b, 1);
  slow.change(&Preset::k_d, 0.001);
  CHECK(session.preset() == without);
  slow.may_go_on = true;
  wait(session);
  CHECK(session.preset().k_b == 1);
  CHECK(session.preset().k_d == 0.001);
  CHECK(session.simulation->steps() == 3);
}

TEST_CASE("a preset that a device is to run is opened once its programs have been built beside the frames") {
  if (test::skipped_without_device()) return;
  const Preset before = test::cloth(20, 20);
  SlowCompiler slow(before);
  Session& session = slow.session;
  Preset opened = test::cloth(12, 12);
  opened.engine = EngineKind::opencl;
  reopen_document(session, opened, {opened, "opened", {}});
  CHECK(session.rebuild.busy());
  CHECK(session.preset() == before);
  session.simulation->advance(1);  // the present cloth goes on
  slow.may_go_on = true;
  wait(session);
  CHECK(slow.builds == 1);
  CHECK(session.preset() == opened);
  CHECK(session.document.label == "opened");
  CHECK(session.simulation->steps() == 0);
}

TEST_CASE("a preset whose device is not there is opened on the CPU, beside the frames too") {
  Session session = session_with(test::cloth(20, 20));
  Preset opened = test::cloth(12, 12);
  opened.engine = EngineKind::opencl, opened.device = 99;
  reopen_document(session, opened, {opened, "opened", {}});
  CHECK(session.rebuild.busy());
  wait(session);
  opened.engine = EngineKind::cpu;
  CHECK(session.preset() == opened);
  CHECK(session.document.label == "opened");
  REQUIRE(session.messages.list().size() == 1);
  CHECK(session.messages.list().front().text.ends_with("The CPU engine runs it instead."));
}

TEST_CASE("a large experiment is there again after a lab, at once, and what was being built for it is built then") {
  const Preset preset = test::cloth(large, large);
  Session session = session_with(preset);
  session.simulation->advance(5);
  session.history.record({preset, 0, "earlier"}, 0);
  Preset finer = preset;
  finer.rows = large + 1;
  REQUIRE(apply_edit(session, edit::Change{finer}));
  REQUIRE(session.rebuild.busy());
  begin_lab(session, "01_hooke");
  apply_requests(session);
  wait(session);
  CHECK(session.document.label == "one_weight");
  leave_lab(session);
  CHECK(session.simulation->steps() == 5);
  CHECK(session.requested_preset() == finer);
  REQUIRE(session.history.next(true) != nullptr);
  CHECK(session.history.next(true)->constants == preset);
  wait(session);
  CHECK(session.preset() == finer);
}

TEST_CASE("a cloth that is built but cannot be taken ends with a message, and nothing stays in work") {
  Session session = session_with(test::cloth(20, 20));
  session.show_texture = [](const std::string&) -> std::optional<std::string> {
    throw std::runtime_error("no texture");
  };
  const Preset next = test::cloth(large, large);
  reopen_document(session, next, {next, "next", {}});
  REQUIRE(session.rebuild.busy());
  wait(session);
  REQUIRE_FALSE(session.messages.list().empty());
  CHECK(session.messages.list().back().severity == Message::Severity::error);
}

TEST_CASE("a change is carried over to other constants alone") {
  const Preset before = test::cloth(8, 8);
  Preset after = before, present = before;
  after.k_s = 9, after.bodies.resize(2);
  present.rows = 5, present.k_s = 1;
  Preset expected = present;
  expected.k_s = 9, expected.bodies.resize(2);
  CHECK(merge(before, after, present) == expected);
}

/// The cloth that is built beside the frames is read from the present one. A worker that is held here, while the
/// session goes on without that cloth, must find it alive when it goes on.
struct HeldWorker {
  HeldWorker() {
    Preset quick = test::cloth(300, 400);
    quick.precision = Precision::float_;
    session = session_with(quick);
    session.simulation->advance(5);
    session.rebuild.before_reading = [this] {
      reached = true;
      while (!may_go_on) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    Preset exact = session.preset();
    exact.precision = Precision::double_;
    REQUIRE(apply_edit(session, edit::Change{exact}));
    REQUIRE(session.rebuild.holds_present());
    while (!reached) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  void open_small() {
    session.rebuild.drop();
    take_built(session, std::make_unique<Simulation>(test::cloth(5, 5)), {.target = {}, .document = Document{}});
  }
  void let_go() { may_go_on = true; }
  ~HeldWorker() { let_go(); }
  std::atomic<bool> reached = false, may_go_on = false;
  Session session;
};

TEST_CASE("a worker that reads the present cloth keeps it alive, whatever is opened, restarted or quit meanwhile") {
  {
    HeldWorker held;
    held.open_small();
    held.let_go();
    wait(held.session);
    CHECK(held.session.simulation->lattice() == Lattice{5, 5});
  }
  {
    HeldWorker held;
    held.open_small();
    apply_edit(held.session, edit::Restart{});
    held.let_go();
    wait(held.session);
    CHECK(held.session.simulation->lattice() == Lattice{5, 5});
  }
  {
    HeldWorker held;
    apply_edit(held.session, edit::Restart{});  // the large cloth's, which follows the one being built
    held.open_small();
    held.let_go();
    wait(held.session);
    CHECK(held.session.simulation->lattice() == Lattice{5, 5});
  }
  {
    HeldWorker held;
    held.open_small();
    held.let_go();  // and the session ends while the worker reads
  }
  {
    HeldWorker held;
    held.let_go();
  }
}

}  // namespace tyglab::building_test
