// Large cloths are built beside the frames: the present one goes on, and what is asked for meanwhile is not lost.
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "app/ui/app.h"
#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::building_test {

constexpr int large = 400;  // rows and columns: above what is built within a frame

App app_with(const Preset& preset) {
  App app;
  app.simulation = std::make_unique<Simulation>(preset);
  app.document.saved = preset;
  return app;
}

Preset changed(Preset preset, int rows) {
  preset.rows = rows;
  return preset;
}

/// Frames pass until nothing is in work.
void wait(App& app) {
  for (int n = 0; n < 20000 && app.building.busy(); ++n) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    app.building.poll(app);
  }
  REQUIRE_FALSE(app.building.busy());
}

TEST_CASE("a small cloth is changed at once, a large one beside the frames") {
  App app = app_with(test::cloth(20, large));
  CHECK(apply_edit(app, edit::Change{changed(app.preset(), 30)}));
  CHECK_FALSE(app.building.busy());
  CHECK(app.preset().rows == 30);
  app.simulation->advance(3);
  CHECK(apply_edit(app, edit::Change{changed(app.preset(), large)}));
  CHECK(app.building.busy());
  CHECK_FALSE(app.building.holds_present());
  CHECK(app.preset().rows == 30);
  CHECK(app.requested_preset().rows == large);
  CHECK(app.building.lattice() == Lattice{large, large});
  app.simulation->advance(1);  // the present one goes on
  CHECK(app.simulation->steps() == 4);
  wait(app);
  CHECK(app.preset().rows == large);
  CHECK(app.simulation->steps() == 0);
  CHECK(app.history.undo(app.preset())->rows == 30);
}

TEST_CASE("what is changed meanwhile is felt at once and by the cloth in work") {
  App app = app_with(test::cloth(20, large));
  app.simulation->advance(3);
  apply_edit(app, edit::Change{changed(app.preset(), large)});
  Preset stiff = app.requested_preset();
  stiff.k_s = 77;
  apply_edit(app, edit::Change{stiff});
  CHECK(app.preset().k_s == 77);
  CHECK(app.preset().rows == 20);
  CHECK(app.requested_preset() == stiff);
  wait(app);
  CHECK(app.preset() == stiff);
  CHECK(app.history.undo(app.preset())->rows == large);
  CHECK(app.history.undo(app.preset())->rows == 20);
}

TEST_CASE("a newer wish replaces one in work, and going back to the present cloth drops it") {
  App app = app_with(test::cloth(20, large));
  const Preset small = app.preset();
  apply_edit(app, edit::Change{changed(small, large)});
  apply_edit(app, edit::Change{changed(small, large + 10)});
  wait(app);
  CHECK(app.preset().rows == large + 10);
  app.simulation = std::make_unique<Simulation>(small);
  apply_edit(app, edit::Change{changed(small, large)});
  apply_edit(app, edit::Change{small});
  CHECK(app.requested_preset() == small);
  wait(app);
  CHECK(app.preset() == small);
}

TEST_CASE("a switch of precision keeps state and time, and lets no edit be lost") {
  Preset quick = test::cloth(large, large);
  quick.precision = Precision::float_;
  App app = app_with(quick);
  app.simulation->advance(5);
  apply_edit(app, edit::Cut{{{200, 200}}});
  const glm::dvec3 x = app.simulation->positions().at(300, 300);
  Preset exact = quick;
  exact.precision = Precision::double_;
  apply_edit(app, edit::Change{exact});
  CHECK(app.building.holds_present());
  CHECK(apply_edit(app, edit::Cut{{{100, 100}}}));
  CHECK_FALSE(apply_edit(app, edit::Grab{300, 300}));
  CHECK(app.simulation->tears().torn_count() == 3);
  wait(app);
  CHECK(app.preset().precision == Precision::double_);
  CHECK(app.simulation->steps() == 5);
  CHECK(app.simulation->tears().torn_count() == 6);
  CHECK(glm::length(app.simulation->positions().at(300, 300) - x) == 0);
}

TEST_CASE("a restart is built beside the frames too, and an engine that is not there leaves everything as it was") {
  App app = app_with(test::cloth(large, large));
  app.simulation->advance(4);
  apply_edit(app, edit::Restart{});
  CHECK(app.simulation->steps() == 4);
  wait(app);
  CHECK(app.simulation->steps() == 0);
  const Preset before = app.preset();
  Preset other = before;
  other.engine = EngineKind::opencl, other.device = 99;
  apply_edit(app, edit::Change{other});
  wait(app);
  CHECK(app.preset() == before);
  CHECK_FALSE(app.history.can_undo());
  CHECK(app.messages.list().size() == 1);
}

/// A cloth on an OpenCL device whose compiler waits until it may go on.
struct SlowCompiler {
  explicit SlowCompiler(const Preset& preset) : app(app_with(preset)) {
    app.building.prepare_programs = [this](const Preset&, bool) {
      ++builds;
      while (!may_go_on) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    app.simulation->advance(3);
  }
  void change(double Preset::*constant, double to) {
    Preset next = app.requested_preset();
    next.*constant = to;
    apply_edit(app, edit::Change{next});
  }
  std::atomic<bool> may_go_on = false;
  std::atomic<int> builds = 0;
  App app;
};

TEST_CASE("the ledger is kept once the program that notes contacts has been built beside the frames") {
  if (!test::device_there()) return;
  Preset preset = test::cloth(20, 20);
  preset.engine = EngineKind::opencl;
  preset.bodies = {Body{}};
  SlowCompiler slow(preset);
  App& app = slow.app;
  CHECK_FALSE(app.building.ledger_ready(app));
  CHECK_FALSE(app.building.ledger_ready(app));  // it is not ordered twice
  app.simulation->advance(2);
  slow.may_go_on = true;
  while (!app.building.ledger_ready(app)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(slow.builds == 1);
  app.simulation->enable_ledger(true);
  app.simulation->advance(1);
  app.simulation->enable_ledger(false);
  CHECK(app.building.ledger_ready(app));  // the program is there now
  CHECK(slow.builds == 1);
  Preset bare = test::cloth(20, 20);
  bare.engine = EngineKind::opencl;
  SlowCompiler other(bare);  // without bodies no other program is needed
  CHECK(other.app.building.ledger_ready(other.app));
}

TEST_CASE("a feature that a device builds a program for is switched on beside the frames") {
  if (!test::device_there()) return;
  Preset without = test::cloth(20, 20);
  without.engine = EngineKind::opencl;
  without.k_b = 0, without.k_d = 0;
  SlowCompiler slow(without);
  App& app = slow.app;
  slow.change(&Preset::k_b, 1);
  CHECK(app.building.programs());
  CHECK_FALSE(app.building.holds_present());
  CHECK(app.preset().k_b == 0);
  CHECK(app.requested_preset().k_b == 1);
  app.simulation->advance(2);  // the old program goes on
  slow.change(&Preset::k_s, 77);
  slow.change(&Preset::k_b, 2);
  CHECK(app.preset().k_s == 77);  // which needs no program
  CHECK(app.preset().k_b == 0);
  slow.may_go_on = true;
  wait(app);
  CHECK(app.preset().k_b == 2);
  CHECK(app.preset().k_s == 77);
  CHECK(slow.builds == 1);
  CHECK(app.simulation->steps() == 5);
  app.simulation->advance(1);
  for (const double k_b : {0.0, 3.0}) {  // both programs are there now
    slow.change(&Preset::k_b, k_b);
    CHECK_FALSE(app.building.busy());
    CHECK(app.preset().k_b == k_b);
  }
}

TEST_CASE("who takes the feature back meanwhile waits for nothing, and two features come one after the other") {
  if (!test::device_there()) return;
  Preset without = test::cloth(20, 20, "velocity_verlet");
  without.engine = EngineKind::opencl;
  without.k_b = 0, without.k_d = 0;
  SlowCompiler slow(without);
  App& app = slow.app;
  slow.change(&Preset::k_b, 1);
  slow.change(&Preset::k_b, 0);
  CHECK(app.building.requested_preset() == nullptr);
  CHECK(app.preset() == without);
  slow.change(&Preset::k_b, 1);
  slow.change(&Preset::k_d, 0.001);
  CHECK(app.preset() == without);
  slow.may_go_on = true;
  wait(app);
  CHECK(app.preset().k_b == 1);
  CHECK(app.preset().k_d == 0.001);
  CHECK(app.simulation->steps() == 3);
}

TEST_CASE("a change is carried over to other constants alone") {
  const Preset before = test::cloth(8, 8);
  Preset after = before, present = before;
  after.k_s = 9, after.bodies.resize(2);
  present.rows = 5, present.k_s = 1;
  Preset expected = present;
  expected.k_s = 9, expected.bodies.resize(2);
  CHECK(rebased(before, after, present) == expected);
}

}  // namespace tyglab::building_test
