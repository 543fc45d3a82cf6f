// A device that is lost in mid-run.
#include "app/session/session.h"

#include <doctest/doctest.h>

#include "tests/support/devices.h"
#include "tests/support/scenes.h"

namespace tyglab::engine_fallback_test {

/// An engine whose device is lost after so many calls of advance().
class LostEngine final : public Engine {
 public:
  LostEngine(std::unique_ptr<Engine> engine, int calls) : engine_(std::move(engine)), left_(calls) {}
  using Engine::load;
  void load(const StateRows& rows, const Tears& tears) override { engine_->load(rows, tears); }
  void synchronize(const Tears& tears) override { engine_->synchronize(tears); }
  void set_preset(const Preset& preset, const Tears& tears) override { engine_->set_preset(preset, tears); }
  void set_fixed(std::span<const int> pinned, Held held) override { engine_->set_fixed(pinned, held); }
  void drive_pins(std::span<const DrivenPin> pins, bool place) override { engine_->drive_pins(pins, place); }
  AdvanceResult advance(int steps, Tears& tears) override {
    if (left_-- == 0) throw EngineError("OpenCL, making a step: the device is not available.");
    return engine_->advance(steps, tears);
  }
  void note_contacts(bool on) override { engine_->note_contacts(on); }
  std::vector<Contact> contacts() const override { return engine_->contacts(); }
  void read(State& state, const Tears& tears) override { engine_->read(state, tears); }
  void read_raw(State& state, const Tears& tears) override { engine_->read_raw(state, tears); }
  PositionView positions() const override { return engine_->positions(); }
  StoredParticle stored(int i, int j) const override { return engine_->stored(i, j); }
  std::size_t bytes() const override { return engine_->bytes(); }
  int threads() const override { return engine_->threads(); }
  SolveCounts solves() const override { return engine_->solves(); }
  InnerSteps inner_steps() const override { return engine_->inner_steps(); }
  std::vector<StepFeature> features() const override { return engine_->features(); }
  std::string name() const override { return engine_->name(); }

 private:
  std::unique_ptr<Engine> engine_;
  int left_;
};

Session app_that_loses_its_device(const Preset& preset, int calls) {
  Session session;
  session.simulation = std::make_shared<Simulation>(preset);
  session.simulation->wrap_engine(
      [&](std::unique_ptr<Engine> engine) { return std::make_unique<LostEngine>(std::move(engine), calls); });
  return session;
}

/// Frames of ten steps until an engine gives up; what follows is the CPU engine's.
void run(Session& session, int frames) {
  for (int n = 0; n < frames; ++n) {
    session.rewind.look(*session.simulation);
    try {
      session.simulation->advance(10);
    } catch (const EngineError& error) {
      fall_back(session, error.what());
    }
  }
}

Preset on_device() {
  Preset preset = test::cloth(20, 30, "rk4");  // which keeps the velocity that is read
  preset.engine = EngineKind::opencl, preset.device = 0, preset.dt = 1e-3;
  return preset;
}

TEST_CASE("a device that is lost: the CPU engine goes on from the last state that was kept, cuts and pins too") {
  if (test::skipped_without_device()) return;
  Session session = app_that_loses_its_device(on_device(), 25);
  session.simulation->apply(edit::Cut{{{10, 10}, {10, 11}}});
  session.simulation->apply(edit::Pin{5, 5, true});
  const int torn = session.simulation->tears().torn_count();
  session.simulation->apply(edit::Grab{15, 15});
  const auto hands = session.counts.hands;
  run(session, 25);
  REQUIRE(session.preset().engine == EngineKind::opencl);
  const Snapshot kept = *session.rewind.before(*session.simulation, session.simulation->time(), 0);
  CHECK(kept.t == doctest::Approx(0.2));
  run(session, 1);
  CHECK(session.preset().engine == EngineKind::cpu);
  CHECK(session.simulation->time() == kept.t);
  CHECK(session.simulation->steps() == kept.steps);
  CHECK(session.simulation->tears().torn_count() == torn);
  CHECK(test::identical(session.simulation->read(), kept.state));
  CHECK(session.counts.hands == hands + 1);  // every tool lets go
  CHECK_FALSE(session.simulation->held());
  REQUIRE(session.messages.list().size() == 1);
  const std::string said = session.messages.list().front().text;
  CHECK(said.find("the device is not available") != std::string::npos);
  CHECK(said.find("The CPU engine continues from t = 0.2") != std::string::npos);
  run(session, 3);
  CHECK(session.simulation->steps() == kept.steps + 30);
  CHECK(test::all_finite(session.simulation->read()));
}

TEST_CASE(
    "a device that is lost before anything was kept: the CPU engine begins anew; and it is never its own rescue") {
  if (test::skipped_without_device()) return;
  Session session = app_that_loses_its_device(on_device(), 0);
  CHECK_THROWS_AS(session.simulation->advance(1), EngineError);
  fall_back(session, "Lost.");
  CHECK(session.preset().engine == EngineKind::cpu);
  CHECK(session.simulation->steps() == 0);
  CHECK_THROWS_AS(fall_back(session, "Lost."), EngineError);
}

}  // namespace tyglab::engine_fallback_test
