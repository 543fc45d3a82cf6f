// An OpenCL device that is lost at the n-th call, by a layer of the loader (tests/support/failing_driver.cpp): the
// engine says so, and in a session the CPU engine goes on.
#include <doctest/doctest.h>

#include "app/session/session.h"
#include "tests/faults/cloth.h"
#include "tests/support/devices.h"
#include "tests/support/faults.h"
#include "tests/support/scenes.h"

namespace tyglab::driver_faults_test {
namespace {

using test::Fault;

Preset on_device(const char* method = "verlet") {
  Preset preset = test::cloth(8, 8, method);
  preset.engine = EngineKind::opencl;
  return preset;
}

bool skipped() {
  if (test::skipped_without_device()) return true;
  REQUIRE(test::driver_faults_there());
  return false;
}

/// A cloth on the device, on which something is done that may fail.
class OnDevice final : public test::Scene {
 public:
  using Act = std::function<void(std::unique_ptr<Simulation>&)>;
  explicit OnDevice(Act act, bool made = true) : act_(std::move(act)) {
    if (made) cloth_ = std::make_unique<Simulation>(on_device());
  }
  void act() override { act_(cloth_); }
  std::string state() override { return cloth_ ? preset_to_json(cloth_->preset()) : "none"; }
  std::string outcome() override { return cloth_ ? "a cloth" : "none"; }
  std::string problem(const test::Attempt& attempt, const std::string& before) override {
    if (std::string wrong = Scene::problem(attempt, before); !wrong.empty()) return wrong;
    if (attempt.sentence.find("OpenCL") == std::string::npos) return "OpenCL is not named: " + attempt.sentence;
    // A device that is lost takes its cloth along.
    if (cloth_) cloth_ = std::make_unique<Simulation>(on_device());
    return {};
  }

 private:
  Act act_;
  std::unique_ptr<Simulation> cloth_;
};

}  // namespace

TEST_CASE("an engine whose device is lost says so" * doctest::test_suite("driver")) {
  if (skipped()) return;
  const Simulation keeps_programs(on_device());
  const auto with_device = [](const char* name, const OnDevice::Act& act, bool made = true) {
    test::inject({.operation = name, .kind = Fault::driver, .dense = 80, .may_pass = true},
                 [&] { return std::make_unique<OnDevice>(act, made); });
  };
  with_device(
      "build on OpenCL", [](auto& cloth) { cloth = std::make_unique<Simulation>(on_device()); }, false);
  with_device("steps on OpenCL", [](auto& cloth) { cloth->advance(3); });
  with_device("hand and cut on OpenCL", [](auto& cloth) {
    cloth->apply(edit::Grab{6, 4});
    cloth->apply(edit::MoveHand{{0.1, 0, 0.1}, 2});
    cloth->apply(edit::Cut{{{4, 4}}});
    cloth->advance(2);
    cloth->apply(edit::Release{});
  });
  with_device("readout on OpenCL", [](auto& cloth) { cloth->snapshot(); });
  with_device("edit on OpenCL", [](auto& cloth) {
    Preset other = cloth->preset();
    other.k_s *= 2, other.dt /= 2;
    cloth->apply(edit::Change{other});
  });
}

TEST_CASE("a session whose device is lost goes on with the CPU engine" * doctest::test_suite("driver")) {
  if (skipped()) return;
  const Simulation keeps_programs(on_device());
  const auto played = [](Session& session) {
    for (int n = 0; n < 3; ++n) {
      session.update(1 / 60.0, {});
      if (n == 1) apply_edit(session, edit::Grab{6, 4});
    }
  };
  std::int64_t tried = 0, survived = 0, all = 1;
  for (std::int64_t n = 0; n <= all; n += n < 60 ? 1 : 7) {
    Session session;
    session.simulation = std::make_shared<Simulation>(on_device());
    session.document.saved = session.preset();
    session.scripted = true;
    const test::Attempt result = test::attempt({Fault::driver, n}, [&] { played(session); });
    if (n == 0) all = result.calls;
    if (!result.met) continue;
    session.update(1 / 60.0, {});
    const bool right = !result.refused && test::all_finite(session.simulation->read()) &&
                       (session.preset().engine == EngineKind::cpu ? !session.messages.list().empty() : true);
    CHECK_MESSAGE(right, n << " of " << all << ": " << result.sentence);
    ++tried, survived += right;
  }
  std::printf("FAULTS session on OpenCL: driver %d %d\n", int(tried), int(survived));
}

}  // namespace tyglab::driver_faults_test
